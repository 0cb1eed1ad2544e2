// A robot that maps and drives in an office; each of its modules hangs or breaks in turn.
#include "robot/platform/robot_health.hpp"

#include <gtest/gtest.h>

#include "robot/platform/robot_modules.hpp"
#include "robot/testing/platform_bench.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
using tasks::RunState;
using vehicle::CommandState;

struct RobotHealthTest : ::testing::Test, testing::PlatformBench {
  RobotHealthTest()
      : PlatformBench(2, [this](Module module) -> base::Task<> {
          while (hung == module) co_await freed.wait();
        }) {}
  void SetUp() override {
    ASSERT_TRUE(run_until([this] { return robot->here().has_value(); }, 5s));
    run = start({ExploreStep{"tour"}});
    ASSERT_TRUE(drives_on());
  }
  bool drives_on() {
    auto const before_m = body->driven_m();
    return run_until([&] { return body->driven_m() > before_m + 1.0; }, 1min);
  }
  /// It comes to stand within the watch period and the way that braking takes, and stays.
  bool stands() {
    run_for(2s);
    auto const stood_at = body->truth();
    run_for(2s);
    return body->truth() == stood_at;
  }
  [[nodiscard]] Clearance clearance() const { return robot->watch().clearance(loop.now()); }
  [[nodiscard]] vehicle::ModulesOfVehicle shown() const { return RobotModules(platform).modules(loop.now()).front(); }
  [[nodiscard]] vehicle::ModuleView shown(std::string_view short_name) const {
    for (auto const& module : shown().modules)
      if (module.short_name == short_name) return module;
    return {};
  }
  vehicle::CommandOutcome command(vehicle::Action action) {
    std::vector<vehicle::VehicleId> const ids{{"robot1"}};
    EXPECT_TRUE(control.command({.action = action}, ids, "anna", true));
    return control.commands().back().outcomes.front();
  }

  std::optional<Module> hung;
  base::Notifier freed{loop};
  std::unique_ptr<tasks::TaskRun> run;
};

TEST_F(RobotHealthTest, ModulesThatAreWellSaySo) {
  auto const all = shown();
  EXPECT_EQ(all.vehicle, vehicle::VehicleId{"robot1"});
  EXPECT_TRUE(all.may_move) << all.reason;
  EXPECT_FALSE(all.needs_restart);
  ASSERT_EQ(all.modules.size(), 4u);
  for (auto const& module : all.modules) {
    EXPECT_TRUE(module.is_required) << module.name;
    EXPECT_EQ(module.state, vehicle::ModuleState::ready) << module.name;
    EXPECT_FALSE(module.error) << module.name;
    EXPECT_GE(module.reports_per_s, 9.0) << module.name;
    EXPECT_LT(*module.since_heard, 200ms) << module.name;
    EXPECT_EQ(module.memory_bytes.has_value(), module.short_name != "CAR") << "a board has a memory of its own";
  }
}

TEST_F(RobotHealthTest, MappingThatHangsStopsTheRobotAndIsNamedUntilItGoesOn) {
  for (auto const module : {Module::mapping, Module::planner}) {
    hung = module;
    EXPECT_TRUE(run_until([&] { return !clearance().may_move; }, 700ms)) << name_of(module).name;
    EXPECT_EQ(clearance().who, module) << clearance().reason;
    EXPECT_EQ(shown().who, name_of(module).short_name);
    EXPECT_TRUE(stands()) << name_of(module).name;
    EXPECT_EQ(shown(name_of(module).short_name).state, vehicle::ModuleState::silent);
    EXPECT_EQ(run->state(), RunState::in_progress) << "the drive waits";
    hung.reset();
    freed.notify_all();
    EXPECT_TRUE(drives_on()) << name_of(module).name;
  }
}

TEST_F(RobotHealthTest, SensorsThatFallSilentStopTheRobotAndAreNamed) {
  body->is_numb = true;
  EXPECT_TRUE(run_until([&] { return !clearance().may_move; }, 500ms));
  EXPECT_EQ(clearance().who, Module::sensors) << clearance().reason;
  EXPECT_TRUE(stands());
  body->is_numb = false;
  EXPECT_TRUE(drives_on());
}

TEST_F(RobotHealthTest, ACarrierThatFallsSilentStopsTheRobot) {
  body->is_silent = true;
  EXPECT_TRUE(run_until([&] { return !clearance().may_move; }, 500ms));
  EXPECT_EQ(shown("CAR").state, vehicle::ModuleState::silent);
  EXPECT_TRUE(stands());
  body->is_silent = false;
  EXPECT_TRUE(drives_on());
}

TEST_F(RobotHealthTest, ACriticalErrorOfTheCarrierStopsTheRobotUntilItIsOver) {
  body->carrier_code = code::right_wheel_dead;
  EXPECT_TRUE(run_until([&] { return !clearance().may_move; }, 200ms));
  EXPECT_EQ(clearance().reason, "carrier (CAR) reports error 204: The right wheel is driven and gives no pulses.");
  EXPECT_TRUE(stands());
  auto const shown_error = shown("CAR").error;
  ASSERT_TRUE(shown_error);
  EXPECT_EQ(shown_error->code, 204);
  EXPECT_EQ(shown_error->severity, vehicle::ModuleSeverity::critical);
  EXPECT_NE(shown_error->what_to_do, "");
  body->carrier_code = code::none;
  EXPECT_TRUE(drives_on());
}

TEST_F(RobotHealthTest, ARobotThatIsCarriedAwayHasLostItsPlaceUntilItIsBack) {
  ASSERT_TRUE(run_until([&] { return robot->survey() && robot->survey()->coverage > 0.9; }, 20min));
  command(vehicle::Action::hold);
  run_for(2s);
  auto const stood_at = body->truth();
  body->carry_to({stood_at.x, stood_at.y > 0.0 ? -2.5 : 2.5, stood_at.yaw + 1.0});
  EXPECT_TRUE(run_until([&] { return !clearance().may_move; }, 5s));
  EXPECT_EQ(clearance().reason, "mapping (MMU) reports error 302: The place on the map is not known any more.");
  body->carry_to(stood_at);
  EXPECT_TRUE(run_until([&] { return clearance().may_move; }, 5s)) << clearance().reason;
}

TEST_F(RobotHealthTest, ALaserThatFallsSilentIsSaidAndIsNoErrorOfMapping) {
  body->is_blind = true;
  run_for(3s);
  EXPECT_EQ(shown("MMU").state, vehicle::ModuleState::ready);
  ASSERT_TRUE(shown("MMU").error);
  EXPECT_EQ(shown("MMU").error->code, code::no_scans);
  EXPECT_TRUE(stands());
}

TEST_F(RobotHealthTest, AnOutageOfTheOperatorsLinkStopsNothing) {
  std::uint16_t link_code = code::none;
  platform.set_communication([&link_code] { return link_code; });
  run_for(1s);
  EXPECT_FALSE(shown("CM").error);
  EXPECT_FALSE(shown("CM").is_required);
  link_code = code::operator_away;
  EXPECT_TRUE(drives_on());
  ASSERT_TRUE(shown("CM").error);
  EXPECT_EQ(shown("CM").error->severity, vehicle::ModuleSeverity::notice);
  EXPECT_TRUE(shown().may_move);
  platform.set_communication({});
  EXPECT_TRUE(drives_on()) << "who watches the link may fall silent, too";
  EXPECT_EQ(shown("CM").state, vehicle::ModuleState::silent);
}

TEST_F(RobotHealthTest, EyesThatFailOrHangAreSaidAndStopNothing) {
  std::optional<std::uint16_t> trouble = code::none;
  Eyes eyes;
  eyes.trouble = [&trouble] { return trouble; };
  platform.open_eyes(*robot, std::move(eyes));
  run_for(1s);
  EXPECT_EQ(shown("POI").state, vehicle::ModuleState::ready);
  EXPECT_FALSE(shown("POI").error);
  EXPECT_FALSE(shown("POI").is_required);
  trouble = code::eyes_away;
  EXPECT_TRUE(drives_on());
  ASSERT_TRUE(shown("POI").error);
  EXPECT_EQ(shown("POI").error->code, 504);
  trouble.reset();
  EXPECT_TRUE(drives_on());
  EXPECT_EQ(shown("POI").state, vehicle::ModuleState::silent);
  EXPECT_TRUE(shown().may_move);
}

TEST_F(RobotHealthTest, AMapThatIsNotKeptIsSaidByMappingAndStopsNothing) {
  bool is_kept = true;
  platform.set_map_keeping([&is_kept] { return is_kept; });
  run_for(1s);
  EXPECT_FALSE(shown("MMU").error);
  is_kept = false;
  EXPECT_TRUE(drives_on());
  ASSERT_TRUE(shown("MMU").error);
  EXPECT_EQ(shown("MMU").error->code, code::map_not_saved);
  is_kept = true;
  EXPECT_TRUE(drives_on());
  EXPECT_FALSE(shown("MMU").error);
}

TEST_F(RobotHealthTest, AfterAKillItStandsUntilAnOperatorRestartsItAndAllAreWell) {
  command(vehicle::Action::disarm);
  EXPECT_TRUE(stands());
  EXPECT_TRUE(shown().needs_restart);
  EXPECT_EQ(shown().reason, "the robot was killed");
  hung = Module::planner;
  run_for(1s);
  auto const refused = command(vehicle::Action::arm);
  EXPECT_EQ(refused.state, CommandState::refused);
  EXPECT_NE(refused.reason.find("planner (PLN) has been silent"), std::string::npos) << refused.reason;
  EXPECT_TRUE(shown().needs_restart);
  hung.reset();
  freed.notify_all();
  run_for(1s);
  EXPECT_FALSE(shown().may_move) << "nobody has restarted it";
  EXPECT_EQ(command(vehicle::Action::arm).state, CommandState::confirmed);
  run_for(1s);
  EXPECT_TRUE(shown().may_move) << shown().reason;
  EXPECT_EQ(command(vehicle::Action::return_home).state, CommandState::under_way);
  EXPECT_TRUE(run_until([this] { return !robot->stands(); }, 5s));
}

TEST_F(RobotHealthTest, AnEmergencyStopThatIsReleasedLeavesARobotThatIsNotWellStopped) {
  control.emergency_stop(std::nullopt, "anna");
  hung = Module::mapping;
  run_for(1s);
  control.release_emergency_stop("anna");
  EXPECT_TRUE(shown().needs_restart);
  hung.reset();
  freed.notify_all();
  run_for(1s);
  EXPECT_TRUE(shown().needs_restart);
  EXPECT_EQ(command(vehicle::Action::arm).state, CommandState::confirmed);
  run_for(1s);
  EXPECT_TRUE(shown().may_move) << shown().reason;
}

TEST_F(RobotHealthTest, WhatThePlannerCannotReachIsSaidUntilItHasAnotherErrand) {
  auto const place = live_map.site("office")->place_of(geo::Point3<geo::SiteFrame>(-15.0, 15.0, 0.0));
  run = start({DriveToPlaceStep{place}});
  ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 10min));
  EXPECT_EQ(run->state(), RunState::failed);
  run_for(1s);
  ASSERT_TRUE(shown("PLN").error);
  EXPECT_EQ(shown("PLN").error->code, code::no_way);
  EXPECT_TRUE(shown().may_move);
  run = start({ReturnStep{}});
  run_for(1s);
  EXPECT_FALSE(shown("PLN").error);
}

}  // namespace
}  // namespace lapwing::robot
