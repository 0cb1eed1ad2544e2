#include "sim/building/body/drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lapwing::sim::building {
namespace {

DriveSettings ideal() {
  return {.motor_spread = 0.0, .wheel_spread = 0.0, .slip_m_per_sqrt_m = 0.0};
}

constexpr double step_s = 0.005;

std::vector<Contact> drive(DrivenBody& body, double seconds, double left, double right, Surroundings const& around) {
  std::vector<Contact> all;
  for (int i = 0; i * step_s < seconds; ++i) {
    auto const contacts = body.step(step_s, left, right, around);
    all.insert(all.end(), contacts.begin(), contacts.end());
  }
  return all;
}

struct Nowhere {
  FaceIndex faces{{}};
  Surroundings around{.fixed = faces};
};

TEST(DrivenBody, ReachesTheSpeedOfItsVoltageWithItsLag) {
  Nowhere nowhere;
  DrivenBody body(ideal(), {}, 1, 0);
  // From standing the grip limits it at first; then what is missing falls to 1/e in each lag.
  drive(body, 0.4, 0.5, 0.5, nowhere.around);
  EXPECT_NEAR(body.speed_m_s(), 0.2, 0.002);
  EXPECT_EQ(drive(body, 1.0, 0.02, 0.02, nowhere.around).size(), 0U);
  EXPECT_NEAR(body.speed_m_s(), 0.0, 1e-4);  // friction holds it
}

TEST(DrivenBody, TurnsOnTheSpot) {
  Nowhere nowhere;
  DrivenBody body(ideal(), {}, 1, 0);
  drive(body, 2.0, -0.25, 0.25, nowhere.around);
  EXPECT_NEAR(body.turn_rad_s(), 0.2 / 0.28, 1e-3);
  EXPECT_LT(distance_m(body.pose().position, {0, 0}), 1e-9);
}

TEST(DrivenBody, CountsPulsesOfItsWheels) {
  Nowhere nowhere;
  DrivenBody body(ideal(), {}, 1, 0);
  drive(body, 5.0, 0.5, 0.5, nowhere.around);
  EXPECT_NEAR(body.pulses(Side::left), body.pose().position.x() * 9'400.0, 2.0);
  drive(body, 20.0, -0.5, -0.5, nowhere.around);
  EXPECT_LT(body.pulses(Side::right), 0);
}

TEST(DrivenBody, SlipsAsFarAsTheSettingsSay) {
  Nowhere nowhere;
  auto settings = ideal();
  settings.slip_m_per_sqrt_m = 0.01;
  // After 4 m each wheel is off by 2 cm on the mean square; the way's middle by that over the root of two.
  double squares = 0.0;
  constexpr int runs = 200;
  for (int i = 0; i < runs; ++i) {
    DrivenBody body(settings, {}, static_cast<std::uint64_t>(i), 0);
    drive(body, 20.06, 0.5, 0.5, nowhere.around);
    double const turned_m = (body.pulses(Side::left) + body.pulses(Side::right)) / 2.0 / settings.pulses_per_m;
    squares += (body.driven_m() - turned_m) * (body.driven_m() - turned_m) / runs;
  }
  EXPECT_NEAR(std::sqrt(squares), 0.02 / std::sqrt(2.0), 0.003);
}

TEST(DrivenBody, IsHeldByWallsAndItsWheelsStall) {
  FaceIndex const wall({{.from = {1.0, 5.0}, .to = {1.0, -5.0}, .thing = Thing::wall, .number = 3}});
  Surroundings const around{.fixed = wall};
  DrivenBody body(ideal(), {}, 1, 0);
  auto const contacts = drive(body, 6.0, 0.5, 0.5, around);
  ASSERT_FALSE(contacts.empty());
  EXPECT_EQ(contacts.front().thing, Thing::wall);
  EXPECT_EQ(contacts.front().number, 3U);
  EXPECT_NEAR(contacts.front().speed_m_s, 0.2, 0.01);
  EXPECT_NEAR(body.pose().position.x(), 1.0 - 0.18, 1e-6);
  auto const pulses = body.pulses(Side::left);
  drive(body, 1.0, 0.5, 0.5, around);
  EXPECT_LT(body.pulses(Side::left) - pulses, 200);
  drive(body, 1.0, -0.5, -0.5, around);
  EXPECT_LT(body.pose().position.x(), 0.7);
}

TEST(DrivenBody, SlidesAlongWhatItMeetsAslantAndStaysOutOfCorners) {
  FaceIndex const corner({{.from = {2.0, -5.0}, .to = {-2.0, -5.0}},
                          {.from = {1.0, 5.0}, .to = {1.0, -5.0}},
                          {.from = {-5.0, 1.0}, .to = {5.0, 1.0}}});
  Surroundings const around{.fixed = corner};
  DrivenBody slider(ideal(), {{0.0, 0.0}, 1.0}, 1, 0);
  drive(slider, 15.0, 0.6, 0.6, around);
  // It meets the wall at x = 0.53 and rubs along it.
  EXPECT_NEAR(slider.pose().position.y(), 0.82, 1e-3);
  EXPECT_GT(slider.pose().position.x(), 0.56);
  EXPECT_LT(slider.pose().position.x(), 0.821);
  DrivenBody body(ideal(), {{0.7, 0.65}, 0.785}, 1, 0);
  drive(body, 15.0, 0.6, 0.6, around);
  EXPECT_NEAR(body.pose().position.x(), 0.82, 1e-3);
  EXPECT_NEAR(body.pose().position.y(), 0.82, 1e-3);
}

TEST(DrivenBody, BumpsIntoPeopleButNotIntoItself) {
  FaceIndex const nothing({});
  Surroundings const around{.fixed = nothing,
                            .posts = {{.middle = {0, 0}, .radius_m = 0.18, .thing = Thing::robot, .number = 0},
                                      {.middle = {1, 0}, .radius_m = 0.22, .thing = Thing::person, .number = 4}}};
  DrivenBody body(ideal(), {}, 1, 0);
  auto const contacts = drive(body, 6.0, 0.5, 0.5, around);
  ASSERT_FALSE(contacts.empty());
  EXPECT_EQ(contacts.front().thing, Thing::person);
  EXPECT_EQ(contacts.front().number, 4U);
  EXPECT_NEAR(body.pose().position.x(), 1.0 - 0.4, 1e-6);
}

TEST(DrivenBody, TurnsAsideWhereOneWheelHasNoGrip) {
  Nowhere nowhere;
  DrivenBody body(ideal(), {}, 1, 0);
  body.set_grip(Side::left, 0.5);
  drive(body, 2.0, 0.5, 0.5, nowhere.around);
  EXPECT_GT(body.pose().yaw_rad, 0.3);
  EXPECT_EQ(body.pulses(Side::left), body.pulses(Side::right));
}

}  // namespace
}  // namespace lapwing::sim::building
