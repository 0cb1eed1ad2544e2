// What breaks on a robot, end to end in simulated time: the building's faults on a board that runs the firmware's
// program, its line, the robot's modules, and what the page is told of them.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/testing/temporary_folder.hpp"
#include "host/session/console.hpp"
#include "host/session/session.hpp"
#include "robot/watch/codes.hpp"
#include "station/messages/health_messages.hpp"

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using sim::building::Fault;
namespace code = robot::code;

/// Three rooms in a row with doorways between them: enough to explore for a minute and more.
constexpr auto rooms = R"(
name = "Rooms"
wall_thickness_m = 0.1

[[wall]]
line = [[0, 0], [12, 0], [12, 4], [0, 4]]
closed = true
[[wall]]
line = [[4, 0], [4, 1.5]]
[[wall]]
line = [[4, 2.5], [4, 4]]
[[wall]]
line = [[8, 0], [8, 2]]
[[wall]]
line = [[8, 3], [8, 4]]

[[start]]
at = [1.5, 2]
)";

struct RobotFaults : ::testing::Test {
  void SetUp() override {
    auto const added = session.add_robots({"sim:" + folder.write("rooms.toml", rooms)},
                                          geo::Wgs84::from_degrees(41.178, -8.598, 90.0));
    ASSERT_TRUE(added) << added.error().message;
    ASSERT_TRUE(comes_true([this] { return robot().here().has_value() && shown().may_move; }, 10s));
    (void)robot().start("tour", {robot::ExploreStep{"nearest"}});
    ASSERT_TRUE(drives());
  }
  bool comes_true(std::function<bool()> const& holds, base::Duration time) {
    auto const deadline = session.loop.now() + time;
    while (!holds() && session.loop.now() < deadline) wait(20ms);
    return holds();
  }
  void wait(base::Duration time) {
    session.loop.run_until_done(
        [](base::Loop& on, base::Duration so_long) -> base::Task<> { co_await on.sleep(so_long); }(session.loop, time));
  }
  vehicle::CommandOutcome command(vehicle::VehicleCommand const& what) {
    std::vector<vehicle::VehicleId> const ids{{"robot1"}};
    EXPECT_TRUE(session.all_control.command(what, ids, "anna", true));
    return session.all_control.commands().back().outcomes.front();
  }
  bool drives() {
    return comes_true([this] { return board().body().speed_m_s() > 0.08; }, 20s);
  }
  [[nodiscard]] bool stands() { return std::abs(board().body().speed_m_s()) < 0.005; }
  [[nodiscard]] sim::building::Robot& board() { return session.buildings.front()->building->robot(0); }
  [[nodiscard]] robot::Robot& robot() { return *session.robots.robots().front(); }
  [[nodiscard]] vehicle::ModulesOfVehicle shown() { return session.robot_modules.modules(session.loop.now()).front(); }
  /// The error that this module reports; 0: none.
  [[nodiscard]] int error_of(std::string_view short_name) {
    for (auto const& module : shown().modules)
      if (module.short_name == short_name) return module.error ? module.error->code : 0;
    return -1;
  }

  base::testing::TemporaryFolder folder;
  Session session{{.speedup = 0.0, .log_level = base::LogLevel::error, .seed = 1}};
};

TEST_F(RobotFaults, ABoardThatIsUnpluggedStopsItselfAndIsNamedUntilItIsBack) {
  board().set({.kind = Fault::Kind::unplugged});
  ASSERT_TRUE(comes_true([this] { return !shown().may_move; }, 400ms)) << "the watch period, and a look";
  ASSERT_TRUE(comes_true([this] { return error_of("CAR") == code::board_away; }, 1s));
  EXPECT_EQ(shown().who, "CAR") << shown().reason;
  ASSERT_TRUE(comes_true([this] { return stands(); }, 1500ms)) << "its own watchdog, whoever lives";
  board().mend(Fault::Kind::unplugged);
  ASSERT_TRUE(comes_true([this] { return shown().may_move; }, 5s)) << shown().reason;
  EXPECT_TRUE(drives()) << "the drive goes on";
}

TEST_F(RobotFaults, AWheelThatGivesNoPulsesStopsTheRobotAndIsNotPushedAgainAtOnce) {
  board().set({.kind = Fault::Kind::encoder_dead, .which = 1});
  ASSERT_TRUE(comes_true([this] { return error_of("CAR") == code::right_wheel_dead; }, 5s));
  ASSERT_TRUE(comes_true([this] { return !shown().may_move; }, 100ms));
  EXPECT_EQ(shown().who, "CAR");
  ASSERT_TRUE(comes_true([this] { return stands(); }, 2s));
  wait(1s);
  EXPECT_FALSE(shown().may_move) << "not before it has been well for a while";
  board().mend(Fault::Kind::encoder_dead);
  EXPECT_TRUE(comes_true([this] { return shown().may_move; }, 5s)) << shown().reason;
  EXPECT_TRUE(drives());
}

TEST_F(RobotFaults, StuckSonarsAreSaidWithTheirCodeAndStopNothing) {
  // All of them, for one that heard nothing goes on to say so, which is no fault.
  for (int sonar = 0; sonar < 5; ++sonar) board().set({.kind = Fault::Kind::sonar_stuck, .which = sonar});
  ASSERT_TRUE(comes_true([this] { return error_of("SIM") == code::sonar_stuck; }, 60s));
  EXPECT_TRUE(shown().may_move);
}

TEST_F(RobotFaults, AWheelThatSlipsIsSaidWithItsCodeAndStopsNothing) {
  board().set({.kind = Fault::Kind::wheel_slips, .which = 0, .amount = 0.4});
  ASSERT_TRUE(comes_true([this] { return error_of("SIM") == code::wheels_slip; }, 30s));
  EXPECT_TRUE(shown().may_move);
}

TEST_F(RobotFaults, WheelsThatSpinOnTheSpotAreSaidUntilTheyDriveItAgain) {
  for (int const wheel : {0, 1}) board().set({.kind = Fault::Kind::wheel_slips, .which = wheel, .amount = 0.0});
  ASSERT_TRUE(comes_true([this] { return error_of("PLN") == code::not_moving; }, 60s));
  EXPECT_TRUE(shown().may_move) << "it may get free";
  board().mend(Fault::Kind::wheel_slips);
  EXPECT_TRUE(comes_true([this] { return error_of("PLN") == code::none; }, 60s));
}

TEST_F(RobotFaults, ASilentInertialUnitIsSaidWithItsCode) {
  board().set({.kind = Fault::Kind::imu_silent});
  EXPECT_TRUE(comes_true([this] { return error_of("SIM") == code::imu_silent; }, 2s));
}

TEST_F(RobotFaults, ALaserThatIsSilentIsSaidByMappingAndTheRobotStands) {
  board().set({.kind = Fault::Kind::laser_silent});
  ASSERT_TRUE(comes_true([this] { return error_of("MMU") == code::no_scans; }, 3s));
  ASSERT_TRUE(comes_true([this] { return stands(); }, 3s));
  board().mend(Fault::Kind::laser_silent);
  EXPECT_TRUE(drives());
}

TEST_F(RobotFaults, AKillHoldsUntilAnOperatorRestartsTheRobot) {
  command({.action = vehicle::Action::disarm});
  ASSERT_TRUE(comes_true([this] { return board().voltages() == std::pair(0.0, 0.0); }, 40ms));
  ASSERT_TRUE(comes_true([this] { return stands(); }, 2s));
  wait(5s);
  EXPECT_TRUE(stands());
  EXPECT_TRUE(shown().needs_restart);
  EXPECT_EQ(command({.action = vehicle::Action::return_home}).state, vehicle::CommandState::refused);
  EXPECT_TRUE(stands());
  EXPECT_EQ(command({.action = vehicle::Action::arm}).state, vehicle::CommandState::confirmed);
  ASSERT_TRUE(comes_true([this] { return shown().may_move; }, 2s)) << shown().reason;
  (void)robot().start("again", {robot::ExploreStep{"nearest"}});
  EXPECT_TRUE(drives());
}

TEST_F(RobotFaults, TheOperatorsLinkMayGoAndNothingStops) {
  session.robots.set_communication([] { return code::operator_away; });
  wait(1s);
  EXPECT_EQ(error_of("CM"), code::operator_away);
  EXPECT_TRUE(shown().may_move);
  EXPECT_TRUE(drives());
}

TEST_F(RobotFaults, AreToldAsTheApiTellsThem) {
  board().set({.kind = Fault::Kind::battery_low, .amount = 0.1});
  ASSERT_TRUE(comes_true([this] { return error_of("CAR") == code::battery_low; }, 2s));
  auto const told = json::parse(station::health_message(session.robot_modules.modules(session.loop.now())));
  auto const& vehicle = told["vehicles"].at(0);
  EXPECT_EQ(vehicle["id"], "robot1");
  EXPECT_EQ(vehicle["may_move"], true);
  auto const& carrier = vehicle["modules"].at(1);
  EXPECT_EQ(carrier["module"], "CAR");
  EXPECT_EQ(carrier["error"]["severity"], "degraded");
  EXPECT_EQ(carrier["error"]["what_to_do"], "Let it return, and charge it.");
  EXPECT_FALSE(carrier.contains("memory_bytes")) << "that is the board's own";
}

}  // namespace
}  // namespace lapwing::host
