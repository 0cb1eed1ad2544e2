#include "onboard/decide/flight_listener.hpp"

#include <gtest/gtest.h>

#include "onboard/decide/flight_hand.hpp"

namespace lapwing::onboard {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint now(100s);
constexpr std::uint32_t prearm_check = 1U << 28U;

FlightHeard heard_all() {
  FlightHeard heard;
  heard.state = {bus::mavros::State{.connected = true, .armed = true, .mode = "GUIDED", .system_status = 4}, now};
  heard.system_status = {
      bus::mavros::SysStatus{
          .sensors_present = prearm_check, .sensors_enabled = prearm_check, .sensors_health = prearm_check},
      now};
  heard.battery = {bus::BatteryState{.percentage = 0.5F}, now};
  heard.position = {bus::NavSatFix{.status = {.status = 0}, .latitude = 43, .longitude = -79, .altitude = 110}, now};
  heard.relative_altitude = {bus::Float64{10.0}, now};
  heard.pose = {bus::PoseStamped{.pose = {.position = {5, 6, 12}}}, now};
  heard.home = {bus::mavros::HomePosition{.geo = {43, -79, 100}, .position = {1, 2, 2}}, now};
  return heard;
}

TEST(FlightHeardTest, IsNothingBeforeTheStateWasHeard) {
  auto heard = heard_all();
  heard.state = {};
  EXPECT_FALSE(heard.told(now));
}

TEST(FlightHeardTest, IsToldWholeAndFromHome) {
  auto const flight = heard_all().told(now);
  ASSERT_TRUE(flight);
  EXPECT_EQ(flight->silence, 0s);
  EXPECT_EQ(flight->mode, "GUIDED");
  EXPECT_TRUE(flight->is_armed);
  EXPECT_TRUE(flight->prearm_ok);
  EXPECT_FALSE(flight->is_critical);
  EXPECT_EQ(flight->gps_fix, autonomy::gps_fix_3d);
  EXPECT_EQ(flight->relative_alt_m, 10.0);
  EXPECT_EQ(flight->local, geo::Point3<autonomy::ArmingFrame>(4, 4, 10));
  EXPECT_FLOAT_EQ(static_cast<float>(flight->battery.value()), 0.5F);
  ASSERT_TRUE(flight->home);
  EXPECT_NEAR(flight->home->alt_m, 100, 1e-9);
}

TEST(FlightHeardTest, LeavesOutWhatIsTooOldToBeBelieved) {
  auto const flight = heard_all().told(now + 1500ms);
  ASSERT_TRUE(flight);
  EXPECT_EQ(flight->silence, 1500ms);
  EXPECT_FALSE(flight->position || flight->relative_alt_m || flight->local);
  EXPECT_EQ(flight->gps_fix, 0);
  EXPECT_TRUE(flight->battery) << "that changes slowly";
  EXPECT_TRUE(flight->home);
  EXPECT_FALSE(heard_all().told(now + 4s)->battery);
}

TEST(FlightHeardTest, BelievesNoPlaceWithoutAFix) {
  auto heard = heard_all();
  heard.position.message->status.status = bus::NavSatStatus::no_fix;
  EXPECT_FALSE(heard.told(now)->position);
  EXPECT_EQ(heard.told(now)->gps_fix, 0);
}

TEST(FlightHeardTest, IsAsSilentAsTheLastThatWasHeardOfIt) {
  auto heard = heard_all();
  heard.pose.at = now + 3s;
  EXPECT_EQ(heard.told(now + 4s)->silence, 1s);
}

TEST(FlightHeardTest, FailsTheChecksOnlyWhenTheFlightControllerSaysSo) {
  auto heard = heard_all();
  heard.system_status.message->sensors_health = 0;
  EXPECT_FALSE(heard.told(now)->prearm_ok);
  heard.system_status.message->sensors_enabled = 0;
  EXPECT_TRUE(heard.told(now)->prearm_ok) << "it makes none";
}

TEST(FlightHeardTest, IsCriticalInAFailsafe) {
  for (auto const& [status, is_critical] : {std::pair{3, false}, {4, false}, {5, true}, {6, true}, {8, true}}) {
    auto heard = heard_all();
    heard.state.message->system_status = static_cast<std::uint8_t>(status);
    EXPECT_EQ(heard.told(now)->is_critical, is_critical) << status;
  }
}

TEST(FlightHeardTest, KnowsNoPlaceWithoutHome) {
  auto heard = heard_all();
  heard.home = {};
  EXPECT_FALSE(heard.told(now)->local);
  EXPECT_FALSE(heard.in_local_frame({1, 2, 3}));
}

TEST(FlightHeardTest, PlacesGoThereAndBack) {
  auto const heard = heard_all();
  geo::Point3<autonomy::ArmingFrame> const place(30, 40, 12);
  EXPECT_EQ(heard.from_home(heard.in_local_frame(place).value()), place);
}

TEST(FlightHandPoses, HaveZerosWhereTheHeadingDoesNotMatter) {
  EXPECT_EQ(orientation_of(std::nullopt), (bus::Quaternion{0, 0, 0, 0}));
  EXPECT_EQ(orientation_of(0.0), (bus::Quaternion{0, 0, 0, 1}));
}

}  // namespace
}  // namespace lapwing::onboard
