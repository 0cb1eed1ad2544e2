#include "station/feeds/vehicles_feed.hpp"

#include <numbers>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

struct VehiclesFeedTest : ::testing::Test {
  static base::TimePoint at(base::Duration since_start) { return base::TimePoint(since_start); }
  vehicle::VehicleState& edit(std::string const& id) {
    vehicle::VehicleId const name{id};
    registry.touch(name);
    return registry.edit(name);
  }
  /// What a viewer is told that has had everything before.
  json news(base::Duration time) {
    auto const before = std::exchange(had, feed.refresh(at(time)));
    return told_since(before, time);
  }
  json told_since(std::uint64_t revision, base::Duration time) {
    auto const frames = feed.since(revision, at(time), 0).frames;
    EXPECT_LE(frames.size(), 1U);
    for (auto const& frame : frames) EXPECT_EQ(frame.revision, feed.refresh(at(time)));
    return frames.empty() ? json() : json::parse(frames[0].content);
  }
  json whole(base::Duration time) { return json::parse(vehicles_message(registry, at(time))); }

  base::Loop loop{{.unpaced = true}};
  vehicle::Registry registry{loop};
  VehiclesFeed feed{registry};
  std::uint64_t had = 1;
};

TEST_F(VehiclesFeedTest, TellsEverythingKnownWithItsAge) {
  auto& state = edit("7");
  state.name = "copter 7";
  state.family = vehicle::Family::copter;
  state.links.heartbeat_heard = at(9500ms);
  state.mode.set("AUTO", at(9500ms));
  state.motion.position.set(geo::Wgs84::from_degrees(52.123456789, 13.5, 100.126), at(9900ms));
  state.motion.heading_rad.set(std::numbers::pi, at(10s));
  state.power.battery.set({.remaining = 0.5, .voltage_v = 12.3456, .current_a = {}}, at(8s));
  auto const message = whole(10s);
  EXPECT_EQ(message["type"], "vehicles");
  EXPECT_EQ(message["full"], true);
  EXPECT_EQ(message["time_s"], 10.0);
  auto const& vehicle = message["vehicles"].at(0);
  EXPECT_EQ(vehicle["id"], "7");
  EXPECT_EQ(vehicle["family"], "copter");
  EXPECT_EQ(vehicle["mode"], "AUTO");
  EXPECT_EQ(vehicle["position"], json({{"lat_deg", 52.1234568}, {"lon_deg", 13.5}, {"alt_m", 100.13}}));
  EXPECT_EQ(vehicle["heading_rad"], 3.142);
  EXPECT_EQ(vehicle["battery"], json({{"remaining", 0.5}, {"voltage_v", 12.35}}));
  EXPECT_EQ(vehicle["age_s"],
            json({{"battery", 2.0}, {"heading_rad", 0.0}, {"heartbeat", 0.5}, {"mode", 0.5}, {"position", 0.1}}));
}

TEST_F(VehiclesFeedTest, TellsSinceWhenAVehicleIsSilentAndNoLossOfNothing) {
  auto& state = edit("1");
  state.links.heard = at(4s);
  state.links.all = {
      {.name = "udp", .loss = 0.0, .messages_per_s = 3.0, .round_trip = {}, .is_alive = true, .is_used = true}};
  auto vehicle = whole(10s)["vehicles"].at(0);
  EXPECT_EQ(vehicle["silent"], false);
  EXPECT_EQ(vehicle["links"].at(0)["loss"], 0.0);
  edit("1").links.is_silent = true;
  vehicle = whole(10s)["vehicles"].at(0);
  EXPECT_EQ(vehicle["silent"], true);
  EXPECT_EQ(vehicle["age_s"]["silent"], 6.0);
  EXPECT_FALSE(vehicle["links"].at(0).contains("loss")) << "0 % of nothing is not known";
}

TEST_F(VehiclesFeedTest, TellsTheHealthOfAVehicleInWords) {
  auto& state = edit("1");
  vehicle::Battery battery{.remaining = 0.4, .voltage_v = {}, .current_a = {}};
  battery.time_left = 333s;
  battery.time_left_error = 42s;
  battery.time_left_is_estimate = true;
  battery.in_flight = vehicle::Endurance{333s, 42s};
  state.power.battery.set(battery, at(9s));
  battery.id = 1;
  state.power.further_batteries = {{battery, at(7s)}};
  state.positioning.gps.set({.fix = 3, .satellites = 11, .hdop = 0.8}, at(9s));
  state.arming.unhealthy.set({"compass"}, at(9s));
  state.arming.reasons = {{2, "PreArm: Compass not calibrated", at(6s)}};
  state.links.remote_control.set({.is_lost = true, .channels = 2, .pulses_us = {1500, 1000}, .rssi = {}}, at(9s));
  state.mission.fence.set({.is_breached = true, .breaches = 1, .type = "boundary"}, at(9s));
  state.mission.progress.set({.current_seq = 2, .total = 5, .complete = false, .state = "active"}, at(9s));
  state.payload.components = {{.id = 154, .kind = "gimbal", .state = "active", .model = "Maker G", .heard = at(8s)}};
  state.payload.gimbal.set({.roll_rad = 0, .pitch_rad = -1.5, .yaw_rad = 0, .yaw_is_from_north = true}, at(9s));
  auto const vehicle = whole(10s)["vehicles"].at(0);
  EXPECT_EQ(vehicle["battery"], json({{"remaining", 0.4},
                                      {"time_left_s", 330.0},
                                      {"time_left_is_estimate", true},
                                      {"time_left_error_s", 40.0},
                                      {"in_flight_s", 330.0},
                                      {"in_flight_error_s", 40.0}}));
  EXPECT_EQ(vehicle["further_batteries"].at(0)["id"], 1);
  EXPECT_EQ(vehicle["age_s"]["further_batteries"], 3.0);
  EXPECT_EQ(vehicle["gps"], json({{"fix", "3D"}, {"satellites", 11}, {"hdop", 0.8}}));
  EXPECT_EQ(vehicle["unhealthy"], json::array({"compass"}));
  EXPECT_EQ(vehicle["arming_reasons"], json::array({"PreArm: Compass not calibrated"}));
  EXPECT_EQ(vehicle["age_s"]["arming_reasons"], 4.0);
  EXPECT_EQ(vehicle["remote_control"], json({{"lost", true}, {"channels", 2}, {"pulses_us", {1500, 1000}}}));
  EXPECT_EQ(vehicle["fence"], json({{"breached", true}, {"breaches", 1}, {"type", "boundary"}}));
  EXPECT_EQ(vehicle["mission"]["state"], "active");
  EXPECT_EQ(vehicle["components"].at(0),
            json({{"id", 154}, {"kind", "gimbal"}, {"state", "active"}, {"model", "Maker G"}}));
  EXPECT_EQ(vehicle["age_s"]["component_154"], 2.0);
  EXPECT_EQ(vehicle["gimbal"]["pitch_rad"], -1.5);
}

TEST_F(VehiclesFeedTest, TakesBackReasonsThatAreGone) {
  edit("1").arming.reasons = {{2, "PreArm: Compass not calibrated", at(1s)}};
  (void)news(1s);
  edit("1").arming.reasons.clear();
  EXPECT_EQ(news(2s)["vehicles"].at(0)["arming_reasons"], json::array());
}

TEST_F(VehiclesFeedTest, TellsWhoCommandsAVehicle) {
  auto& state = edit("7");
  state.control = {.commander = "anna", .asked_for_by = "ben", .granted_at = at(12s)};
  state.foreign_change.set("station 252/190 commanded MISSION_START", at(9s));
  auto const vehicle = whole(10s)["vehicles"].at(0);
  EXPECT_EQ(vehicle["control"], json({{"commander", "anna"}, {"asked_for_by", "ben"}, {"granted_at_s", 12.0}}));
  EXPECT_EQ(vehicle["foreign_change"], "station 252/190 commanded MISSION_START");
  EXPECT_EQ(vehicle["age_s"]["foreign_change"], 1.0);
}

TEST_F(VehiclesFeedTest, ListsAVehicleOfWhichNothingIsKnownYet) {
  (void)registry.edit({"1"});
  EXPECT_EQ(whole(1s)["vehicles"].at(0)["id"], "1");
  EXPECT_EQ(news(1s)["vehicles"].at(0)["id"], "1");
}

TEST_F(VehiclesFeedTest, LeavesOutWhatWasNeverHeard) {
  edit("1");
  auto const vehicle = whole(1s)["vehicles"].at(0);
  for (auto const* key : {"mode", "armed", "position", "battery", "texts"}) EXPECT_FALSE(vehicle.contains(key)) << key;
}

TEST_F(VehiclesFeedTest, SendsOnlyWhatChanged) {
  auto& state = edit("1");
  state.arming.armed.set(true, at(1s));
  state.motion.relative_alt_m.set(10.0, at(1s));
  EXPECT_EQ(news(1s)["vehicles"].at(0)["armed"], true);
  EXPECT_TRUE(news(2s).is_null());

  edit("1").motion.relative_alt_m.set(11.0, at(2s));
  EXPECT_EQ(news(2500ms)["vehicles"],
            json::array({{{"id", "1"}, {"relative_alt_m", 11.0}, {"age_s", {{"relative_alt_m", 0.5}}}}}));
}

TEST_F(VehiclesFeedTest, SendsTheAgeAloneOfAValueHeardAgain) {
  edit("1").arming.armed.set(true, at(1s));
  (void)news(1s);
  edit("1").arming.armed.set(true, at(3s));
  EXPECT_EQ(news(3s)["vehicles"], json::array({{{"id", "1"}, {"age_s", {{"armed", 0.0}}}}}));
}

TEST_F(VehiclesFeedTest, IsSilentWhenATouchChangedNothing) {
  edit("1");
  (void)news(1s);
  edit("1");
  EXPECT_TRUE(news(2s).is_null());
}

TEST_F(VehiclesFeedTest, TellsTheLastOfWhatASlowViewerMissedWithItsAge) {
  edit("1").arming.armed.set(true, at(1s));
  edit("2").arming.armed.set(true, at(1s));
  (void)news(1s);
  auto const had_then = had;
  edit("1").motion.relative_alt_m.set(10.0, at(2s));
  (void)news(2s);
  edit("1").motion.relative_alt_m.set(11.0, at(3s));
  (void)news(3s);
  auto const missed = told_since(had_then, 5s);
  EXPECT_EQ(missed["full"], false);
  EXPECT_EQ(missed["vehicles"],
            json::array({{{"id", "1"}, {"relative_alt_m", 11.0}, {"age_s", {{"relative_alt_m", 2.0}}}}}));
  EXPECT_TRUE(told_since(had, 5s).is_null());
  EXPECT_EQ(told_since(0, 5s)["full"], true);
  EXPECT_EQ(told_since(0, 5s)["vehicles"].size(), 2U);
}

TEST_F(VehiclesFeedTest, TellsAgainOfWhatWasGone) {
  edit("1").recent_texts = {{.severity = 6, .text = "here", .heard = at(1s)}};
  (void)news(1s);
  edit("1").recent_texts.clear();
  EXPECT_TRUE(news(2s).is_null());
  edit("1").recent_texts = {{.severity = 6, .text = "here", .heard = at(1s)}};
  EXPECT_EQ(news(3s)["vehicles"].at(0)["texts"].size(), 1U);
}

TEST_F(VehiclesFeedTest, SurvivesNumbersAndTextsThatAreNone) {
  auto& state = edit("1");
  state.motion.relative_alt_m.set(std::numeric_limits<double>::quiet_NaN(), at(1s));
  state.recent_texts = {{.severity = 3, .text = "bad \xff byte", .heard = at(1s)}};
  auto const vehicle = whole(1s)["vehicles"].at(0);
  EXPECT_TRUE(vehicle["relative_alt_m"].is_null());
  EXPECT_EQ(vehicle["texts"].at(0), json({{"severity", 3}, {"text", "bad \xEF\xBF\xBD byte"}}));
}

}  // namespace
}  // namespace lapwing::station
