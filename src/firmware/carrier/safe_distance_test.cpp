#include "firmware/carrier/safe_distance.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "firmware/testing/rig.hpp"

namespace lapwing::firmware {
namespace {

using namespace std::chrono_literals;
using testing::Rig;

Drive ahead(CommandNumber number, float speed_m_s) {
  return {.number = number, .speed_m_s = speed_m_s, .by = Drive::By::heading, .turn = 0};
}

std::uint16_t echo(float range_m) {
  return static_cast<std::uint16_t>(range_m * echo_us_per_m);
}

/// How near the hull came to the wall.
float nearest_over(Rig& rig, Time span) {
  float nearest = rig.body.clearance_m();
  for (Time past{0}; past < span; past += Rig::step) {
    rig.run(Rig::step);
    nearest = std::min(nearest, rig.body.clearance_m());
  }
  return nearest;
}

TEST(SafeDistance, StandsJustBeyondTheSafeDistanceBeforeAWallAtAnySpeed) {
  for (float const speed : {0.05F, 0.16F, 0.3F}) {
    Rig rig;
    rig.body.wall_x_m = 1.0F;
    rig.run(100ms);
    rig.tell(ahead(1, speed));
    EXPECT_GT(nearest_over(rig, 20s), 0.05F) << speed;
    EXPECT_LT(rig.body.clearance_m(), 0.08F) << speed;
    EXPECT_TRUE(rig.last().has(Flag::too_near)) << speed;
    EXPECT_NEAR(rig.body.speed_m_s(), 0, 0.01F) << speed;
  }
}

TEST(SafeDistance, TouchesNothingWithSonarsThatAreTwoCentimetresOff) {
  Rig rig;
  rig.body.wall_x_m = 1.2F;
  rig.body.echo_noise_m = 0.02F;
  rig.run(100ms);
  rig.tell(ahead(1, 0.3F));
  EXPECT_GT(nearest_over(rig, 20s), 0.025F);
}

TEST(SafeDistance, BrakesForWhatStepsIntoTheWayAtFullSpeed) {
  Rig rig;
  rig.body.wall_x_m = 9.0F;
  rig.run(100ms);
  rig.tell(ahead(1, 0.3F));
  rig.run(3s);
  ASSERT_GT(rig.body.speed_m_s(), 0.28F);
  rig.body.wall_x_m = rig.body.x_m() + 0.15F + 0.12F;
  EXPECT_GT(nearest_over(rig, 5s), 0.03F);
}

TEST(SafeDistance, GoesBackFromAPersonWhoComesNearerThoughThePlannerWantsAhead) {
  Rig rig;
  rig.body.wall_x_m = 0.6F;
  rig.run(100ms);
  rig.tell(ahead(1, 0.16F));
  rig.run(6s);
  float const stood_at = rig.body.x_m();
  rig.body.wall_x_m = rig.body.x_m() + 0.15F + 0.02F;
  rig.tell(ahead(2, 0.16F));
  ASSERT_TRUE(rig.run_until([&] { return rig.body.clearance_m() > 0.05F; }, 3s));
  EXPECT_LT(rig.body.x_m(), stood_at - 0.02F);
  EXPECT_TRUE(std::ranges::any_of(
      rig.readings(), [](Readings const& r) { return r.has(Flag::too_near) && r.left_output_permille < 0; }));
  rig.run(4s);
  EXPECT_GT(rig.body.clearance_m(), 0.045F);
}

TEST(SafeDistance, GoesOnByItselfWhenTheWayIsFreeAgain) {
  Rig rig;
  rig.body.wall_x_m = 0.26F;
  rig.run(100ms);
  rig.tell(ahead(1, 0.16F));
  rig.run(6s);
  ASSERT_TRUE(rig.last().has(Flag::too_near));
  EXPECT_TRUE(rig.completed().empty());
  rig.body.wall_x_m.reset();
  rig.run(3s);
  EXPECT_FALSE(rig.last().has(Flag::too_near));
  EXPECT_NEAR(rig.body.speed_m_s(), 0.16F, 0.01F);
  EXPECT_EQ(rig.completed(), std::vector<CommandNumber>{1});
  EXPECT_GE(rig.count(LogCode::far_enough), 1);
}

TEST(SafeDistance, DoesNotMoveByItselfWhereNobodyWantsItToMove) {
  Rig rig;
  rig.body.wall_x_m = 0.17F;
  rig.run(3s);
  EXPECT_EQ(rig.body.x_m(), 0.0F);
  rig.tell(Turn{.number = 1, .heading_rad = 0.3F});
  rig.run(2s);
  EXPECT_NEAR(rig.body.x_m(), 0.0F, 0.005F);
}

TEST(SafeDistance, DrivesAwayFromWhatIsTooNearWhenItIsToldTo) {
  Rig rig;
  rig.body.wall_x_m = 0.17F;
  rig.run(100ms);
  rig.tell(ahead(1, -0.16F));
  rig.run(3s);
  EXPECT_LT(rig.body.x_m(), -0.3F);
}

TEST(SafeDistance, AStrayEchoDoesNotSendItBack) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 0.16F));
  rig.run(2s);
  float furthest = rig.body.x_m();
  rig.body.echoes = std::vector<std::uint16_t>{echo(0.01F), 0, 0, 0, 0};
  for (int i = 0; i < 6; ++i) {
    rig.run(Rig::step);
    EXPECT_GE(rig.body.x_m(), furthest);
    furthest = rig.body.x_m();
  }
  rig.body.echoes.reset();
  rig.run(1s);
  EXPECT_GT(rig.body.x_m(), furthest + 0.05F);
}

TEST(SafeDistance, GoesBackNoFurtherThanItMayAndSaysSo) {
  Rig rig;
  rig.run(100ms);
  rig.tell(ahead(1, 0.1F));
  rig.run(2s);
  // A sonar that is stuck, or a thing that follows.
  rig.body.echoes = std::vector<std::uint16_t>{echo(0.01F), 0, 0, 0, 0};
  rig.run(300ms);
  float const x = rig.body.x_m();
  rig.run(15s);
  EXPECT_NEAR(rig.body.x_m(), x - 0.2F, 0.05F);
  EXPECT_NEAR(rig.body.speed_m_s(), 0, 0.005F);
  EXPECT_EQ(rig.count(LogCode::no_way_back), 1);
}

TEST(SafeDistance, GoesBackNoFurtherThanTheLaserSeesRoom) {
  auto body = testing::office_robot();
  body.laser = {
      .beams = 2, .x_m = 0, .y_m = 0, .first_angle_rad = 0, .step_rad = 3.14159F, .longest_m = 8, .scan_duration_s = 0};
  Rig rig(body);
  rig.run(100ms);
  rig.body.scan_mm = std::vector<std::uint16_t>{0, 270};  // 12 cm behind the hull
  rig.body.echoes = std::vector<std::uint16_t>{echo(0.01F), 0, 0, 0, 0};
  rig.tell(ahead(1, 0.1F));
  rig.run(10s);
  EXPECT_LT(rig.body.x_m(), -0.03F);
  EXPECT_GT(rig.body.x_m(), -0.075F);
}

TEST(SafeDistance, AKillIsStrongerThanGoingBack) {
  Rig rig;
  rig.run(100ms);
  rig.body.echoes = std::vector<std::uint16_t>{echo(0.01F), 0, 0, 0, 0};
  rig.tell(ahead(1, 0.1F));
  rig.run(1s);
  ASSERT_LT(rig.body.left_output(), 0);
  rig.tell(Kill{});
  rig.run(Rig::step);
  EXPECT_EQ(rig.body.left_output(), 0.0F);
  rig.run(1s);
  float const x = rig.body.x_m();
  rig.run(1s);
  EXPECT_EQ(rig.body.x_m(), x);
}

TEST(Surroundings, ALaserSeesWhatNoSonarHearsAndNotTheBodyItself) {
  auto body = testing::office_robot();
  body.laser = {
      .beams = 4, .x_m = 0, .y_m = 0, .first_angle_rad = 0, .step_rad = 1.5708F, .longest_m = 8, .scan_duration_s = 0};
  Surroundings surroundings(body, {});
  std::vector<std::uint16_t> const ranges{100, 60, 650, 0};
  surroundings.see({.time = {}, .ranges_mm = ranges}, 0);
  EXPECT_EQ(surroundings.clearance(0).ahead_m, nothing_near_m);
  EXPECT_NEAR(surroundings.clearance(0).back_m, 0.5F, 1e-3F);
  EXPECT_NEAR(surroundings.clearance(-0.2F).back_m, 0.3F, 1e-3F);
}

TEST(Surroundings, NothingComesNearerOnALongWayWithoutALaser) {
  Surroundings const surroundings(testing::office_robot(), {});
  EXPECT_EQ(surroundings.clearance(5'000).ahead_m, nothing_near_m);
  EXPECT_EQ(surroundings.clearance(-5'000).back_m, nothing_near_m);
}

TEST(Surroundings, WallsAtTheSidesOfACorridorAreNotInTheWay) {
  auto const body = testing::office_robot();
  Surroundings surroundings(body, {});
  // A corridor 60 cm wide: 16 cm on each side of the hull.
  std::vector<std::uint16_t> const echoes{0, echo(0.44F), echo(0.44F), echo(0.16F), echo(0.16F)};
  surroundings.hear(echoes);
  EXPECT_EQ(surroundings.clearance(0).ahead_m, nothing_near_m);
}

}  // namespace
}  // namespace lapwing::firmware
