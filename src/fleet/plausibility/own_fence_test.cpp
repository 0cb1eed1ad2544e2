#include "fleet/plausibility/own_fence.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

// The vehicle's own fence is read before it moves: soon, once, and again when it changes.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using tasks::RunState;
using vehicle::Action;
using vehicle::CommandState;
using vehicle::VehicleId;

geo::Wgs84 north(double metres) {
  return geo::displaced(TestAutopilot::home, {.north = metres});
}
/// ArduPilot's, round home.
std::map<std::string, float> circle_of(float radius_m) {
  return {{"FENCE_ENABLE", 1.0F},   {"FENCE_TYPE", 7.0F},       {"FENCE_RADIUS", radius_m}, {"FENCE_ACTION", 1.0F},
          {"FENCE_MARGIN", 2.0F},   {"FENCE_AUTOENABLE", 0.0F}, {"FENCE_OPTIONS", 0.0F},    {"FENCE_TOTAL", 0.0F},
          {"FENCE_ALT_MAX", 80.0F}, {"FENCE_ALT_MIN", -10.0F}};
}
mavlink::MissionItem no_fly_circle(geo::Wgs84 center, float radius_m) {
  mavlink::MissionItem item;
  item.command = MavCmd::nav_fence_circle_exclusion;
  item.type = mavlink::MissionType::fence;
  item.params[0] = radius_m;
  item.place = {.lat_rad = center.lat_rad, .lon_rad = center.lon_rad, .z_m = 0.0};
  return item;
}

struct OperatorsFence : ::testing::Test {
  OperatorsFence() : copter(world.add_flying()) { copter.parameters = circle_of(300.0F); }

  vehicle::CommandOutcome go_to(double north_m) {
    auto const number = world.give({.action = Action::go_to, .place = north(north_m)});
    (void)world.run_until([&] {
      auto const state = world.outcome(number).state;
      return state != CommandState::waiting || copter.commands_heard(MavCmd::do_reposition) > 0;
    });
    return world.outcome(number);
  }
  [[nodiscard]] bool is_refused(double north_m) { return go_to(north_m).state == CommandState::refused; }
  /// How many messages of that type it has been sent.
  template <class M>
  [[nodiscard]] int heard() const {
    return static_cast<int>(
        std::ranges::count_if(copter.heard, [](auto const& message) { return std::holds_alternative<M>(message); }));
  }

  ControlWorld world;
  TestAutopilot& copter;
};

TEST_F(OperatorsFence, RefusesWhatLeavesIt) {
  auto const outcome = go_to(420);
  EXPECT_EQ(outcome.state, CommandState::refused);
  EXPECT_NE(outcome.reason.find("120 m outside copter 1's own fence: 300 m round home (FENCE_RADIUS)"),
            std::string::npos)
      << outcome.reason;
  EXPECT_EQ(copter.commands_heard(MavCmd::do_reposition), 0);
  EXPECT_FALSE(is_refused(200));
}

TEST(OperatorsTakeOff, StaysInTheFenceThoughNobodySaidAHeight) {
  ControlWorld world;
  auto& copter = world.add_ready();
  copter.parameters = circle_of(300.0F);
  copter.parameters["FENCE_ALT_MAX"] = 8.0F;
  auto const number = world.give({.action = Action::take_off});
  EXPECT_EQ(world.end_of(number), CommandState::refused);
  EXPECT_NE(world.outcome(number).reason.find("2.0 m above copter 1's own fence: 8 m above home (FENCE_ALT_MAX)"),
            std::string::npos)
      << world.outcome(number).reason;
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
}

TEST_F(OperatorsFence, IsAskedForOnce) {
  EXPECT_TRUE(is_refused(420));
  auto const asked = heard<mavlink::ParamRequestRead>();
  EXPECT_GT(asked, 0);
  EXPECT_TRUE(is_refused(430));
  EXPECT_EQ(heard<mavlink::ParamRequestRead>(), asked);
  world.run_for(61s);
  EXPECT_TRUE(is_refused(440));
  EXPECT_GT(heard<mavlink::ParamRequestRead>(), asked) << "another station may have changed it where nobody here heard";
}

TEST_F(OperatorsFence, FollowsAValueThatIsChanged) {
  EXPECT_TRUE(is_refused(420));
  copter.send(mavlink::ParamValue{.name = "FENCE_RADIUS", .value = 500.0F});
  world.run_for(100ms);
  EXPECT_FALSE(is_refused(420));
}

TEST_F(OperatorsFence, FollowsAreasThatAreReplaced) {
  EXPECT_FALSE(is_refused(200));
  copter.fence = {no_fly_circle(north(200), 30.0F)};
  copter.send(mavlink::MissionAck{.target = {99, 190}, .type = mavlink::MissionType::fence});
  world.run_for(1s);
  copter.heard.clear();
  auto const outcome = go_to(200);
  EXPECT_EQ(outcome.state, CommandState::refused);
  EXPECT_NE(outcome.reason.find("inside what copter 1's own fence shuts out: stored area 1"), std::string::npos)
      << outcome.reason;
}

TEST_F(OperatorsFence, DoesNotDelayWhatFollowsTheFirst) {
  EXPECT_FALSE(is_refused(100));
  copter.heard.clear();
  auto const before = world.loop.now();
  EXPECT_FALSE(is_refused(150));
  EXPECT_LT(world.loop.now() - before, 100ms);
}

TEST_F(OperatorsFence, ThatIsNotToldIsSaidAndHoldsNobodyUpForLong) {
  copter.parameters.clear();
  auto const before = world.loop.now();
  EXPECT_FALSE(is_refused(420));
  EXPECT_LT(world.loop.now() - before, hasty + 500ms);
  EXPECT_TRUE(world.has_logged("copter 1 has not told its own fence (FENCE_ENABLE): nobody knows"));
  copter.heard.clear();
  auto const again = world.loop.now();
  EXPECT_FALSE(is_refused(430));
  EXPECT_LT(world.loop.now() - again, 100ms) << "it is not asked in vain with every command";
}

TEST_F(OperatorsFence, MayLackWhatOlderVersionsLack) {
  for (auto const* name : {"FENCE_AUTOENABLE", "FENCE_OPTIONS", "FENCE_ALT_MIN"}) copter.parameters.erase(name);
  auto const before = world.loop.now();
  EXPECT_TRUE(is_refused(420));
  EXPECT_LT(world.loop.now() - before, 1s);
  EXPECT_FALSE(world.has_logged("has not told its own fence"));
}

TEST_F(OperatorsFence, IsNotWaitedForByWhatStopsAVehicle) {
  copter.parameters.clear();
  for (auto const action : {Action::hold, Action::land, Action::return_home}) {
    copter.heard.clear();
    auto const before = world.loop.now();
    (void)world.give({.action = action});
    ASSERT_TRUE(world.run_until([&] { return copter.commands_heard(MavCmd::do_set_mode) > 0; }));
    EXPECT_LT(world.loop.now() - before, 100ms);
  }
  (void)world.give({.action = Action::go_to, .place = north(100)});  // is asking
  world.run_for(500ms);
  auto const before = world.loop.now();
  copter.heard.clear();
  world.control->emergency_stop(std::nullopt, "operator 1");
  ASSERT_TRUE(world.run_until([&] { return copter.commands_heard(MavCmd::do_set_mode) > 0; }));
  EXPECT_LT(world.loop.now() - before, 100ms);
}

TEST_F(OperatorsFence, IsAllowedByName) {
  auto const number =
      world.give({.action = Action::go_to, .place = north(420), .allow = {{"outside_fence", "the field is longer"}}});
  EXPECT_NE(world.end_of(number), CommandState::refused) << world.outcome(number).reason;
  EXPECT_TRUE(world.has_logged("allowed: the field is longer"));
}

TEST_F(OperatorsFence, IsForgottenWhenTheVehicleRestarts) {
  EXPECT_TRUE(is_refused(420));
  copter.parameters = circle_of(600.0F);
  copter.reboot(world.hub.connect());
  world.run_for(3s);
  copter.is_armed = copter.is_flying = true;
  copter.change_mode(copter_mode::guided);
  world.run_for(5s);
  copter.heard.clear();
  EXPECT_FALSE(is_refused(420));
}

TEST(OwnFenceOfAPx4, IsReadInItsOwnWords) {
  FenceMemory memory;
  auto const whole = [](std::int32_t value) { return std::bit_cast<float>(value); };
  base::TimePoint const now{};
  auto const note = [&](std::string name, float value, mavlink::MavParamType type) {
    memory.note(mavlink::ParamValue{.name = std::move(name), .value = value, .type = type}, vehicle::Autopilot::px4,
                now);
  };
  note("GF_ACTION", whole(3), mavlink::MavParamType::int32);
  note("GF_MAX_HOR_DIST", 250.0F, mavlink::MavParamType::real32);
  note("GF_MAX_VER_DIST", 0.0F, mavlink::MavParamType::real32);
  auto const fence = memory.known(vehicle::Autopilot::px4, vehicle::Family::copter);
  ASSERT_TRUE(fence);
  EXPECT_EQ(fence->radius_m, 250.0);
  EXPECT_EQ(fence->highest_m, std::nullopt) << "0 is none";
  EXPECT_FALSE(fence->only_tells);
  note("GF_ACTION", whole(1), mavlink::MavParamType::int32);
  EXPECT_TRUE(memory.known(vehicle::Autopilot::px4, vehicle::Family::copter)->only_tells);
  note("GF_ACTION", whole(0), mavlink::MavParamType::int32);
  EXPECT_FALSE(memory.known(vehicle::Autopilot::px4, vehicle::Family::copter));
}

TEST(Run, DoesNotArmForAMissionThatLeavesTheVehiclesFence) {
  TestWorld world;
  auto& copter = world.add();
  copter.parameters = circle_of(250.0F);
  world.run_for(5s);
  auto const run = world.platform->start(task_of(mission_ending_with(MavCmd::nav_land)), VehicleId{"1"});
  ASSERT_TRUE(world.run_until([&] { return run->state() != RunState::in_progress; }));
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_NE(run->error().find("50.0 m outside copter 1's own fence: 250 m round home (FENCE_RADIUS)"),
            std::string::npos)
      << run->error();
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
  EXPECT_TRUE(copter.mission.empty());
}

}  // namespace
}  // namespace lapwing::fleet
