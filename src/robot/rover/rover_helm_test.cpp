// Who may drive a rover, as its autopilot sees it.
#include "robot/rover/rover_helm.hpp"

#include "robot/rover/testing/rover_bench.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::robot::rover {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using testing::guided;
using testing::hold;
using testing::manual;

struct RoverHelmTest : testing::RoverBench {
  static constexpr auto arming = MavCmd::component_arm_disarm;
};

TEST_F(RoverHelmTest, LeavesARoverAloneUntilItIsToDrive) {
  run_for(3s);
  drive_for(1s, {});
  EXPECT_EQ(rover->mode, manual);
  EXPECT_EQ(rover->commanded(arming, 1.0F), 0);
  EXPECT_EQ(rover->commanded(arming, 0.0F), 0);
  EXPECT_TRUE(rover->all<mavlink::SetPositionTargetLocalNed>().empty());
}

TEST_F(RoverHelmTest, ArmsItInGuidedToDrive) {
  set_off();
  EXPECT_EQ(rover->commanded(arming, 1.0F), 1);
}

TEST_F(RoverHelmTest, HoldsItWhenItHasStoodAndDisarmsItLater) {
  set_off();
  drive_for(2s, {});
  EXPECT_EQ(rover->mode, guided) << "it may go on at once";
  EXPECT_TRUE(rover->stands());
  drive_for(3s, {});
  EXPECT_EQ(rover->mode, hold);
  EXPECT_TRUE(rover->is_armed);
  drive_for(30s, {});
  EXPECT_FALSE(rover->is_armed);
  drive_for(1s, ahead);
  EXPECT_FALSE(rover->stands()) << "and has it again";
  EXPECT_FALSE(readings.back().is_killed);
}

TEST_F(RoverHelmTest, SaysWhyItMayNotDriveAndAsksAgain) {
  rover->objects_to_arming = "Arm: Gyros inconsistent";
  run_for(2s);
  drive_for(5s, ahead);
  EXPECT_TRUE(rover->stands());
  EXPECT_TRUE(has_logged("it says \"Arm: Gyros inconsistent\""));
  EXPECT_EQ(body->take_carrier_code(), code::not_let_drive);
  EXPECT_LE(rover->commanded(arming, 1.0F), 3) << "not in every reading";
  rover->objects_to_arming.reset();
  drive_for(3s, ahead);
  EXPECT_FALSE(rover->stands());
  EXPECT_EQ(body->take_carrier_code(), code::none);
}

TEST_F(RoverHelmTest, DoesNotTakeItFromWhoDrivesIt) {
  rover->is_armed = true;  // in MANUAL
  run_for(2s);
  drive_for(3s, ahead);
  EXPECT_EQ(rover->mode, manual);
  EXPECT_TRUE(has_logged("somebody else drives it in MANUAL"));
}

TEST_F(RoverHelmTest, LeavesItToAPilotWhoTakesItUntilItIsRestarted) {
  set_off();
  drive_for(3s, ahead);
  rover->mode = manual;
  drive_for(3s, ahead);
  EXPECT_EQ(rover->mode, manual);
  EXPECT_TRUE(rover->is_armed) << "the pilot's";
  EXPECT_TRUE(readings.back().is_killed);
  EXPECT_EQ(body->take_carrier_code(), code::killed);
  rover->mode = hold;
  run_for(1s);
  body->release();
  drive_for(2s, ahead);
  EXPECT_FALSE(rover->stands());
  EXPECT_FALSE(readings.back().is_killed);
}

TEST_F(RoverHelmTest, TakesAFailsafeForAStopUntilItIsRestarted) {
  set_off();
  drive_for(3s, ahead);
  rover->say("GCS Failsafe");
  rover->mode = hold;
  drive_for(3s, ahead);
  EXPECT_EQ(rover->mode, hold);
  EXPECT_TRUE(readings.back().is_killed);
  EXPECT_TRUE(has_logged("it says \"GCS Failsafe\""));
}

TEST_F(RoverHelmTest, KillsAtOnceAndForGood) {
  set_off();
  body->kill();
  run_for(10ms);
  EXPECT_EQ(rover->mode, hold);
  EXPECT_FALSE(rover->is_armed);
  run_for(200ms);
  EXPECT_TRUE(readings.back().is_killed);
  drive_for(5s, ahead);
  EXPECT_EQ(rover->mode, hold);
  EXPECT_TRUE(rover->stands());
  EXPECT_TRUE(has_logged("killed: in HOLD and disarmed, as it showed after 0.0"));
  body->release();
  drive_for(2s, ahead);
  EXPECT_FALSE(rover->stands());
}

TEST_F(RoverHelmTest, KillsWhatIsBeingArmed) {
  rover->objects_to_arming = "Arm: wait";
  run_for(2s);
  drive_for(300ms, ahead);
  ASSERT_EQ(rover->mode, guided);
  body->kill();
  rover->objects_to_arming.reset();
  drive_for(5s, ahead);
  EXPECT_EQ(rover->mode, hold);
  EXPECT_FALSE(rover->is_armed);
}

TEST_F(RoverHelmTest, KillsUntilTheAutopilotObeys) {
  set_off();
  rover->is_deaf_to_stops = true;
  body->kill();
  drive_for(2s, ahead);
  EXPECT_FALSE(readings.back().is_killed) << "it does not show it";
  EXPECT_TRUE(rover->stands()) << "by its speed: nothing follows the last setpoint, zero";
  rover->is_deaf_to_stops = false;
  drive_for(3s, ahead);
  EXPECT_EQ(rover->mode, hold);
  EXPECT_FALSE(rover->is_armed);
  EXPECT_TRUE(readings.back().is_killed);
}

TEST_F(RoverHelmTest, KillsARoverThatWasAwayWhenItIsBack) {
  set_off();
  hub.cut(true);
  body->kill();
  run_for(5s);
  EXPECT_EQ(rover->mode, guided);
  EXPECT_TRUE(rover->stands()) << "the autopilot's own three seconds";
  hub.cut(false);
  run_for(3s);
  EXPECT_EQ(rover->mode, hold);
  EXPECT_FALSE(rover->is_armed);
}

TEST_F(RoverHelmTest, StopsAgainWhatALateCommandHasArmed) {
  set_off();
  body->kill();
  run_for(2s);
  rover->mode = guided;
  rover->is_armed = true;
  run_for(3s);
  EXPECT_EQ(rover->mode, hold);
  EXPECT_FALSE(rover->is_armed);
  run_for(15s);
  rover->mode = manual;
  rover->is_armed = true;
  run_for(5s);
  EXPECT_EQ(rover->mode, manual) << "its pilot's by now";
  drive_for(2s, ahead);
  EXPECT_EQ(rover->mode, manual);
}

TEST_F(RoverHelmTest, DrivesNoOtherKindOfVehicle) {
  rover->type = mavlink::MavType::quadrotor;
  run_for(2s);
  drive_for(3s, ahead);
  EXPECT_EQ(rover->mode, manual);
  EXPECT_TRUE(readings.empty());
  EXPECT_TRUE(has_logged("system 1 is no rover of ArduPilot"));
  body->kill();
  run_for(1s);
  EXPECT_FALSE(rover->is_armed);
}

TEST_F(RoverHelmTest, HoldsAndDisarmsItWhenTheProgramGoes) {
  set_off();
  body.reset();
  run_for(10ms);
  EXPECT_EQ(rover->mode, hold);
  EXPECT_FALSE(rover->is_armed);
}

}  // namespace
}  // namespace lapwing::robot::rover
