#include "fleet/actions/vehicle_actions.hpp"

#include <gtest/gtest.h>

#include "fleet/testing/world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using mavlink::MavSeverity;

struct VehicleActions : ::testing::Test {
  VehicleActions() { world.run_for(5s); }
  [[nodiscard]] MavlinkVehicle& craft() const { return *world.fleet->find(vehicle::VehicleId{"1"}); }
  base::Result<> start() {
    return world.loop.run_until_done(arm_and_start(world.connection, craft(), ActionOptions{}));
  }

  TestWorld world;
  TestAutopilot& copter = world.add();
};

TEST_F(VehicleActions, GiveTheFirstReasonAndNotTheLastWord) {
  world.run_for(1s);
  auto const since = world.loop.now();
  copter.say(MavSeverity::critical, "Auto: Missing Takeoff Cmd");
  copter.say(MavSeverity::warning, "Mode change to AUTO failed: init failed");
  world.run_for(100ms);
  EXPECT_EQ(given_reason(craft(), since), "Auto: Missing Takeoff Cmd");
}

TEST_F(VehicleActions, GiveTheLastWordWhereTheReasonWasLost) {
  world.run_for(1s);
  auto const since = world.loop.now();
  copter.say(MavSeverity::warning, "Mode change to AUTO failed: init failed");
  copter.send_as({1, 100}, mavlink::StatusText{.severity = MavSeverity::error, .text = "camera is out of film"});
  world.run_for(100ms);
  EXPECT_EQ(given_reason(craft(), since), "Mode change to AUTO failed: init failed");
}

TEST_F(VehicleActions, DisarmWhatTheyHaveArmedForAStartThatFailed) {
  world.run_for(5s);
  copter.refused_commands.insert(MavCmd::mission_start);
  copter.refused_modes.insert(copter_mode::automatic);
  auto const started = start();
  ASSERT_FALSE(started);
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 2);
  EXPECT_FALSE(copter.is_armed);
  EXPECT_EQ(started.error().message.find("still armed"), std::string::npos) << started.error().message;
}

TEST_F(VehicleActions, LeaveAloneWhatWasArmedBeforeAStartThatFailed) {
  copter.is_armed = copter.is_flying = true;
  world.run_for(5s);
  copter.refused_commands.insert(MavCmd::mission_start);
  copter.refused_modes.insert(copter_mode::automatic);
  EXPECT_FALSE(start());
  EXPECT_TRUE(copter.is_armed);
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
}

TEST_F(VehicleActions, AskAVehicleAgainThatIsBusy) {
  world.run_for(5s);
  copter.times_busy = 3;
  EXPECT_TRUE(start());
  EXPECT_TRUE(copter.is_armed);
  EXPECT_EQ(copter.mode, copter_mode::automatic);
}

TEST_F(VehicleActions, TellWhatIsMissing) {
  world.run_for(5s);
  EXPECT_EQ(why_not_ready(craft()), "");
  copter.say(MavSeverity::critical, "PreArm: Compass not calibrated");
  world.run_for(1s);
  EXPECT_EQ(why_not_ready(craft()), "PreArm: Compass not calibrated");
}

}  // namespace
}  // namespace lapwing::fleet
