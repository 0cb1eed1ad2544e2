#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "mavlink/exchange/mission_transfer.hpp"
#include "mavlink/wire/modes.hpp"
#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

constexpr std::uint32_t loiter = px4_mode(4, 3);
constexpr std::uint32_t mission_mode = px4_mode(4, 4);

std::optional<MavResult> enter(TestGround& ground, float main, float sub) {
  return ground.command(MavCmd::do_set_mode, {1.0F, main, sub});
}

base::Result<> upload(TestGround& ground, std::vector<MissionItem> items) {
  return ground.loop.run_until_done(upload_mission(ground.gcs, {1, 1}, std::move(items)));
}

std::vector<MissionItem> out_and_back(TestGround& ground) {
  auto const make = ground.maker();
  return {make.take_off(20), make.waypoint(60, 0, 20), make.waypoint(60, 40, 25),
          ItemMaker::plain(MavCmd::nav_return_to_launch)};
}

/// Brings it into the air to this altitude above the sea, where it loiters.
void take_off(TestGround& ground, float altitude_m) {
  ground.boot();
  ground.command(MavCmd::nav_takeoff, {0, 0, 0, NAN, NAN, NAN, altitude_m});
  ground.arm();
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().mode().number == loiter; }, 30s));
}

TEST(Px4, SaysWhoItIs) {
  TestGround ground("px4");
  ground.boot();
  auto const heartbeat = ground.last<Heartbeat>();
  ASSERT_TRUE(heartbeat);
  EXPECT_EQ(heartbeat->autopilot, MavAutopilot::px4);
  EXPECT_EQ(heartbeat->type, MavType::quadrotor);
  EXPECT_EQ(heartbeat->custom_mode, loiter);
  EXPECT_EQ(heartbeat->base_mode, 0x1D);
  EXPECT_EQ(heartbeat->system_status, MavState::standby);
  EXPECT_EQ(ground.command(MavCmd::request_message, {148}), MavResult::accepted);
  auto const capabilities = ground.last<AutopilotVersion>()->capabilities;
  EXPECT_NE(capabilities & 16U, 0u) << "parameters are bytewise";
  EXPECT_EQ(capabilities & 2U, 0u);
  EXPECT_EQ(ground.gcs.parser_counters(0).junk_bytes, 0u) << "no console text between its frames";
}

TEST(Px4, SendsTelemetryUnaskedWithItsOwnEstimatorMessage) {
  TestGround ground("px4");
  ground.boot();
  auto const from = ground.heard.size();
  ground.run_for(10s);
  EXPECT_NEAR(static_cast<double>(ground.all<GlobalPosition>(1, from).size()), 50.0, 2.0);
  ASSERT_FALSE(ground.all<EstimatorStatus>(1, from).empty());
  EXPECT_EQ(ground.last<EstimatorStatus>()->flags, 0x33F);
  EXPECT_TRUE(ground.all<EkfStatusReport>().empty());
  EXPECT_EQ(ground.command(MavCmd::set_message_interval, {193, 100000}), MavResult::failed) << "it has none such";
  EXPECT_EQ(ground.command(MavCmd::set_message_interval, {33, -1}), MavResult::accepted);
  EXPECT_EQ(ground.command(MavCmd::set_message_interval, {33, 0}), MavResult::accepted);
  auto const again = ground.heard.size();
  ground.run_for(4s);
  EXPECT_NEAR(static_cast<double>(ground.all<GlobalPosition>(1, again).size()), 20.0, 2.0) << "0 is its own rate";
}

TEST(Px4, RefusesForNowWhatItCannotDo) {
  TestGround ground("px4");
  ground.boot();
  EXPECT_EQ(enter(ground, 4, 4), MavResult::temporarily_rejected) << "no mission";
  EXPECT_EQ(enter(ground, 3, 0), MavResult::temporarily_rejected) << "no sticks";
  EXPECT_EQ(enter(ground, 6, 0), MavResult::temporarily_rejected) << "no setpoints";
  EXPECT_EQ(enter(ground, 42, 0), MavResult::temporarily_rejected);
  EXPECT_EQ(enter(ground, 4, 5), MavResult::accepted);
  EXPECT_EQ(ground.arm(), MavResult::temporarily_rejected) << "nobody arms in a return";
  ground.run_for(100ms);
  EXPECT_EQ(ground.said("Arming denied: "), 1);
  EXPECT_EQ(ground.command(MavCmd::do_set_mission_current, {0}), MavResult::unsupported);
  EXPECT_EQ(ground.command(MavCmd::request_message, {300}), MavResult::denied);
}

TEST(Px4, TakesOffToAnAltitudeAboveTheSeaAndHoldsThere) {
  TestGround ground("px4");
  ground.boot();
  float const altitude = static_cast<float>(ground.world.options().home.alt_m) + 15.0F;
  EXPECT_EQ(ground.command(MavCmd::nav_takeoff, {0, 0, 0, NAN, NAN, NAN, altitude}), MavResult::accepted);
  EXPECT_EQ(ground.pilot().mode().name, "AUTO.TAKEOFF");
  EXPECT_EQ(ground.arm(), MavResult::accepted);
  EXPECT_TRUE(ground.run_until([&] { return ground.pilot().mode().number == loiter; }, 30s));
  ground.run_for(5s);
  EXPECT_NEAR(ground.pilot().body().height_m(), 15.0, 0.5);
  EXPECT_EQ(ground.last<Heartbeat>()->base_mode, 0x9D);
  EXPECT_EQ(ground.last<Heartbeat>()->system_status, MavState::active);
  EXPECT_EQ(ground.command(MavCmd::nav_land), MavResult::accepted);
  EXPECT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 60s));
  ground.run_for(100ms);
  EXPECT_EQ(ground.said("Disarmed by landing"), 1);
}

TEST(Px4, ClimbsToItsOwnHeightWhenNoneIsGiven) {
  TestGround ground("px4");
  ground.set("MIS_TAKEOFF_ALT", 6.0F);
  take_off(ground, NAN);
  ground.run_for(5s);
  EXPECT_NEAR(ground.pilot().body().height_m(), 6.0, 0.5);
}

TEST(Px4, AsksForItemsByNumberFromZeroAndKeepsThemAsTheyWere) {
  TestGround ground("px4");
  ground.boot();
  auto const items = out_and_back(ground);
  ASSERT_TRUE(upload(ground, items));
  EXPECT_EQ(ground.all<MissionRequestInt>().size(), 4u);
  EXPECT_TRUE(ground.all<MissionRequest>().empty());
  auto const got = ground.loop.run_until_done(download_mission(ground.gcs, {1, 1}));
  ASSERT_TRUE(got);
  EXPECT_TRUE(compare_readback(items, got->items, MavAutopilot::px4).empty());
  ground.request(MessageId::mission_current, 5);
  ground.run_for(1s);
  EXPECT_EQ(ground.last<MissionCurrent>()->seq, 0);
  EXPECT_EQ(ground.last<MissionCurrent>()->total, 4);
}

TEST(Px4, KeepsTheOldMissionUntilTheNewOneIsWhole) {
  TestGround ground("px4");
  ground.boot();
  ASSERT_TRUE(upload(ground, out_and_back(ground)));
  ground.send(MissionCount{.count = 2});
  ground.run_for(500ms);
  auto first = out_and_back(ground)[0];
  first.seq = 0;
  ground.send(first);
  ground.run_for(6s);
  EXPECT_EQ(ground.last<MissionAck>()->result, MavMissionResult::operation_cancelled);
  EXPECT_EQ(ground.vehicle().mission().size(), 5u) << "four and home";
}

TEST(Px4, JumpsToTheItemThatTheWireNames) {
  TestGround ground("px4");
  ground.boot();
  auto const make = ground.maker();
  std::vector<MissionItem> const items{make.take_off(10), make.waypoint(30, 0, 10), make.waypoint(0, 0, 10),
                                       ItemMaker::plain(MavCmd::do_jump, {1.0F, 1.0F}),
                                       ItemMaker::plain(MavCmd::nav_land)};
  ASSERT_TRUE(upload(ground, items));
  EXPECT_EQ(ground.vehicle().mission()[4].params[0], 2.0F);
  auto const got = ground.loop.run_until_done(download_mission(ground.gcs, {1, 1}));
  ASSERT_TRUE(got);
  EXPECT_EQ(got->items[3].params[0], 1.0F);
}

TEST(Px4, FliesAMissionAndDisarmsAfterLanding) {
  TestGround ground("px4");
  ground.boot();
  ASSERT_TRUE(upload(ground, out_and_back(ground)));
  ground.request(MessageId::mission_current, 5);
  EXPECT_EQ(ground.command(MavCmd::mission_start), MavResult::accepted) << "which arms, too";
  EXPECT_TRUE(ground.pilot().armed());
  EXPECT_EQ(ground.pilot().mode().number, mission_mode);
  EXPECT_TRUE(ground.run_until([&] { return ground.pilot().body().height_m() > 15.0; }, 30s));
  EXPECT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 200s));
  ground.run_for(500ms);
  EXPECT_LT(ground.from_start(), 1.5);
  EXPECT_EQ(ground.said("Mission: "), 0) << "that is ArduPilot's";
  std::set<int> reached;
  for (auto const& item : ground.all<MissionItemReached>()) reached.insert(item.seq);
  EXPECT_TRUE(reached.contains(1) && reached.contains(2));
  EXPECT_EQ(ground.last<MissionCurrent>()->state, MissionState::complete);
}

TEST(Px4, DisarmsWhenNothingFollowsTheArming) {
  TestGround ground("px4");
  ground.boot();
  EXPECT_EQ(ground.arm(), MavResult::accepted);
  ground.run_for(9s);
  EXPECT_TRUE(ground.pilot().armed());
  ground.run_for(2s);
  EXPECT_FALSE(ground.pilot().armed());
}

TEST(Px4, GoesWhereItIsSentAndIsGuidedFromOutside) {
  TestGround ground("px4");
  take_off(ground, 100);
  auto const there = geo::displaced(ground.world.options().home, {40, 0, -10});
  CommandInt const go{.frame = MavFrame::global,
                      .command = MavCmd::do_reposition,
                      .params = {-1, 1, 0, NAN},
                      .place = {.lat_rad = there.lat_rad, .lon_rad = there.lon_rad, .z_m = there.alt_m}};
  ground.send(go);
  ground.run_for(20s);
  EXPECT_NEAR(ground.from_start(), 40.0, 1.0);
  SetPositionTargetGlobalInt setpoint;
  setpoint.setpoint.ignore = 0b110111000111;
  setpoint.setpoint.velocity_m_s = {0, 3, 0};
  for (int i = 0; i < 20; ++i) {
    ground.send(setpoint);
    ground.run_for(250ms);
    if (i != 2) continue;
    EXPECT_EQ(enter(ground, 6, 0), MavResult::accepted);
  }
  EXPECT_GT(ground.pilot().body().position_m.east, 5.0);
  EXPECT_EQ(ground.pilot().mode().name, "OFFBOARD");
  ground.run_for(2s);
  EXPECT_EQ(ground.pilot().mode().number, loiter) << "nobody guides it any more";
}

TEST(Px4, HoldsAtItsFenceInACriticalState) {
  TestGround ground("px4");
  ground.set("GF_MAX_HOR_DIST", 30.0F);
  ground.boot();
  ASSERT_TRUE(upload(ground, out_and_back(ground)));
  ground.command(MavCmd::mission_start);
  EXPECT_TRUE(ground.run_until([&] { return ground.pilot().mode().number == loiter; }, 60s));
  ground.run_for(1500ms);
  EXPECT_EQ(ground.said("Failsafe activated: Fence breached"), 1);
  EXPECT_EQ(ground.last<Heartbeat>()->system_status, MavState::critical);
}

TEST(Px4, LandsWithoutGps) {
  TestGround ground("px4");
  take_off(ground, 105);
  ParamSet const set{.name = "SIM_GPS_USED", .value = std::bit_cast<float>(0), .type = MavParamType::int32};
  ground.send(set);
  ground.run_for(10s);
  EXPECT_EQ(ground.pilot().mode().name, "AUTO.LAND");
  EXPECT_EQ(ground.pilot().system_status(), MavState::critical);
}

// ---- parameters

TEST(Px4Parameters, TravelAsTheirBytes) {
  TestGround ground("px4");
  ground.boot();
  ground.send(ParamRequestRead{.name = "SYS_AUTOSTART"});
  ground.run_for(100ms);
  auto const value = ground.last<ParamValue>();
  ASSERT_TRUE(value);
  EXPECT_EQ(value->type, MavParamType::int32);
  EXPECT_EQ(std::bit_cast<std::int32_t>(value->value), 4001);
  ground.send(ParamSet{.name = "COM_RCL_EXCEPT", .value = std::bit_cast<float>(7), .type = MavParamType::int32});
  ground.send(ParamSet{.name = "MIS_TAKEOFF_ALT", .value = 8.5F, .type = MavParamType::real32});
  ground.run_for(100ms);
  EXPECT_EQ(ground.vehicle().parameters().value("COM_RCL_EXCEPT"), 7.0);
  EXPECT_EQ(ground.vehicle().parameters().value("MIS_TAKEOFF_ALT"), 8.5);
}

TEST(Px4Parameters, RefuseAnotherType) {
  TestGround ground("px4");
  ground.boot();
  ground.send(ParamSet{.name = "COM_RCL_EXCEPT", .value = 7.0F, .type = MavParamType::real32});
  ground.run_for(100ms);
  EXPECT_EQ(ground.vehicle().parameters().value("COM_RCL_EXCEPT"), 0.0);
  EXPECT_EQ(ground.said("param types mismatch"), 1);
}

TEST(Px4Parameters, HaveAHashThatChangesWithThemAndEndsTheirList) {
  TestGround ground("px4");
  ground.boot();
  ground.send(ParamRequestRead{.name = "_HASH_CHECK"});
  ground.run_for(100ms);
  auto const hash = ground.last<ParamValue>();
  ASSERT_TRUE(hash && hash->name == "_HASH_CHECK");
  EXPECT_EQ(hash->type, MavParamType::uint32);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(hash->value), ground.vehicle().parameters().hash());
  auto const before = ground.vehicle().parameters().hash();
  ground.set("RTL_RETURN_ALT", 61.0F);
  EXPECT_NE(ground.vehicle().parameters().hash(), before);
  auto const from = ground.heard.size();
  ground.send(ParamRequestList{});
  ground.send(ParamSet{.name = "_HASH_CHECK",
                       .value = std::bit_cast<float>(ground.vehicle().parameters().hash()),
                       .type = MavParamType::uint32});
  ground.run_for(2s);
  auto const sent = ground.all<ParamValue>(1, from);
  EXPECT_LT(sent.size(), ground.vehicle().parameters().all().size()) << "the ground knows them";
}

}  // namespace
}  // namespace lapwing::sim
