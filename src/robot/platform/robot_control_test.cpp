#include "robot/platform/robot_control.hpp"

#include <gtest/gtest.h>

#include "robot/testing/platform_bench.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
using tasks::RunState;
using vehicle::Action;
using vehicle::CommandState;

struct RobotControlTest : ::testing::Test, testing::PlatformBench {
  void SetUp() override {
    ASSERT_TRUE(run_until([this] { return robot->here().has_value(); }, 5s));
  }
  vehicle::CommandOutcome const& command(vehicle::VehicleCommand const& what, std::string const& by = "anna",
                                         bool takes_over = false) {
    std::vector<vehicle::VehicleId> const ids{{"robot1"}};
    EXPECT_TRUE(control.command(what, ids, by, takes_over));
    return control.commands().back().outcomes.front();
  }
  std::unique_ptr<tasks::TaskRun> explore() {
    auto run = start({ExploreStep{"tour"}});
    EXPECT_TRUE(run_until([this] { return body->driven_m() > 1.0; }, 1min));
    return run;
  }
};

TEST_F(RobotControlTest, HoldStopsWhateverAScriptDoesWithIt) {
  auto const run = explore();
  auto const& outcome = command({.action = Action::hold});
  EXPECT_EQ(run->state(), RunState::failed);
  run_for(3s);
  EXPECT_EQ(outcome.state, CommandState::confirmed) << outcome.reason;
  EXPECT_TRUE(robot->stands());
  EXPECT_EQ(state().control.commander, "anna");
}

TEST_F(RobotControlTest, SendsItToAPlaceAndBack) {
  auto run = explore();
  run_for(30s);
  run->stop();
  loop.run_until_done(platform.settle());
  auto const place = live_map.site("office")->place_of(geo::Point3<geo::SiteFrame>(1.5, 0.0, 0.0));
  auto const& there = command({.action = Action::go_to, .place = place});
  EXPECT_EQ(there.state, CommandState::under_way);
  ASSERT_TRUE(run_until([&] { return vehicle::is_over(there.state); }, 2min));
  EXPECT_EQ(there.state, CommandState::confirmed) << there.reason;
  EXPECT_LT(std::hypot(body->truth().x - 1.5, body->truth().y), 0.3);
  auto const& back = command({.action = Action::return_home});
  ASSERT_TRUE(run_until([&] { return vehicle::is_over(back.state); }, 2min));
  EXPECT_EQ(back.state, CommandState::confirmed) << back.reason;
  EXPECT_LT(std::hypot(body->truth().x, body->truth().y), 0.6);
}

TEST_F(RobotControlTest, RefusesWhatARobotCannotDoOrSomebodyElseHas) {
  EXPECT_EQ(command({.action = Action::take_off}).reason, "robot 1 is a robot: take_off is nothing that it can do");
  ASSERT_TRUE(authority.claim({"robot1"}, "ben"));
  auto const place = live_map.site("office")->anchor();
  auto const& refused = command({.action = Action::go_to, .place = place});
  EXPECT_EQ(refused.state, CommandState::refused);
  EXPECT_EQ(refused.reason, "robot 1 is commanded by ben");
  EXPECT_EQ(command({.action = Action::go_to, .place = place}, "anna", true).state, CommandState::under_way);
  EXPECT_EQ(state().control.commander, "anna");
  EXPECT_FALSE(control.command({.action = Action::go_to}, std::vector<vehicle::VehicleId>{{"robot1"}}, "anna", false));
  EXPECT_FALSE(control.command({.action = Action::hold}, {}, "anna", false));
}

TEST_F(RobotControlTest, TheEmergencyStopStandsItStillUntilItIsReleased) {
  auto const run = explore();
  control.emergency_stop(std::nullopt, "anna");
  auto const stopped_at = body->truth();
  run_for(3s);
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_EQ(run->error(), "emergency stop by anna");
  EXPECT_LT(slam::distance_m(body->truth(), stopped_at), 0.02);
  auto const& stop = control.emergency();
  EXPECT_TRUE(stop.is_latched);
  ASSERT_EQ(stop.vehicles.size(), 1u);
  EXPECT_TRUE(stop.vehicles.front().is_confirmed) << stop.vehicles.front().detail;
  EXPECT_TRUE(state().carrier.report.value->is_killed);

  // Whoever lets it go by another way is stopped again.
  body->release();
  run_for(2s);
  EXPECT_TRUE(robot->is_killed());
  EXPECT_NE(start({ReturnStep{}})->error(), "");
  EXPECT_EQ(command({.action = Action::return_home}).reason, "emergency stop by anna: release it first");

  control.release_emergency_stop("anna");
  EXPECT_FALSE(control.emergency().is_latched);
  run_for(1s);
  EXPECT_FALSE(robot->is_killed());
  auto const again = start({ReturnStep{}});
  ASSERT_TRUE(run_until([&] { return again->state() != RunState::in_progress; }, 2min));
  EXPECT_EQ(again->state(), RunState::done) << again->error();
}

TEST_F(RobotControlTest, DisarmingStopsItUntilItIsArmed) {
  auto const& stop = command({.action = Action::disarm});
  run_for(2s);
  EXPECT_EQ(stop.state, CommandState::confirmed);
  EXPECT_TRUE(robot->is_killed());
  EXPECT_EQ(command({.action = Action::return_home}).reason, "it is stopped: let it go again first (arm)");
  EXPECT_EQ(command({.action = Action::arm}).state, CommandState::confirmed);
  run_for(1s);
  EXPECT_FALSE(robot->is_killed());
}

}  // namespace
}  // namespace lapwing::robot
