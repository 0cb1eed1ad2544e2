#include "robot/rover/rover_body.hpp"

#include <algorithm>
#include <cmath>

#include "map/live/live_map.hpp"
#include "robot/platform/robot_platform.hpp"
#include "robot/rover/testing/rover_bench.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::robot::rover {
namespace {

using namespace std::chrono_literals;

using RoverBodyTest = testing::RoverBench;

TEST_F(RoverBodyTest, TellsWhereItIsTenTimesASecond) {
  run_for(2s);
  readings.clear();
  run_for(2s);
  EXPECT_NEAR(static_cast<double>(readings.size()), 20.0, 1.0);
  EXPECT_DOUBLE_EQ(readings.back().battery.value_or(0.0), 0.9);
  EXPECT_DOUBLE_EQ(readings.back().speed_m_s, 0.0);
  EXPECT_EQ(body->take_carrier_code(), code::none);
  EXPECT_EQ(body->take_carrier_code(), std::nullopt) << "nothing new was heard of it";
}

TEST_F(RoverBodyTest, DrivesAheadBackAndTurnsOnTheSpot) {
  set_off();
  auto const last = [&] { return rover->all<mavlink::SetPositionTargetLocalNed>().back(); };
  drive_for(500ms, {.speed_m_s = 0.25, .turn_rad_s = 0.5});
  EXPECT_EQ(last().frame, mavlink::MavFrame::body_ned);
  EXPECT_EQ(last().ignore, 1479) << "as ArduPilot's pages have it for a velocity with a turn rate";
  EXPECT_NEAR(last().velocity_m_s.north, 0.25, 1e-6);
  EXPECT_NEAR(last().yaw_rate_rad_s, -0.5, 1e-6) << "clockwise on the wire, counterclockwise here";
  drive_for(1s, {});
  auto before = readings.back().odometry;
  drive_for(2s, {.turn_rad_s = 0.5});
  auto const turned = slam::between(before, readings.back().odometry);
  EXPECT_NEAR(turned.yaw, 1.0, 0.25);
  EXPECT_LT(std::hypot(turned.x, turned.y), 0.1);
  drive_for(1s, {});
  before = readings.back().odometry;
  drive_for(2s, {.speed_m_s = -0.1});
  EXPECT_LT(slam::between(before, readings.back().odometry).x, -0.1);
}

TEST_F(RoverBodyTest, SendsCommandsOftenerThanTheAutopilotForgetsThem) {
  set_off();
  auto const before = rover->all<mavlink::SetPositionTargetLocalNed>().size();
  drive_for(2s, ahead);
  EXPECT_GE(rover->all<mavlink::SetPositionTargetLocalNed>().size() - before, 10U) << "five a second";
}

TEST_F(RoverBodyTest, StandsAtOnceWhenItIsToldTo) {
  set_off();
  body->drive({});
  run_for(10ms);
  EXPECT_TRUE(rover->stands());
}

TEST_F(RoverBodyTest, StandsByItselfWhenNobodyRenewsItsCommand) {
  set_off();
  run_for(400ms);
  EXPECT_FALSE(rover->stands());
  run_for(300ms);
  EXPECT_TRUE(rover->stands());
  EXPECT_TRUE(readings.back().is_waiting);
  drive_for(300ms, ahead);
  EXPECT_FALSE(rover->stands());
  EXPECT_FALSE(readings.back().is_waiting);
}

TEST_F(RoverBodyTest, FallsSilentWithItsAutopilot) {
  set_off();
  rover->is_mute = true;
  run_for(1s);
  readings.clear();
  run_for(2s);
  EXPECT_TRUE(readings.empty());
  EXPECT_EQ(body->take_carrier_code(), code::board_away);
  run_for(20s);
  EXPECT_FALSE(has_logged("does not say where it is")) << "it says nothing";
  rover->is_mute = false;
  run_for(1s);
  EXPECT_EQ(body->take_carrier_code(), code::none);
}

TEST_F(RoverBodyTest, TellsALostPlaceFromALostAutopilot) {
  run_for(2s);
  rover->has_place = false;
  run_for(1s);
  readings.clear();
  run_for(15s);
  EXPECT_TRUE(readings.empty()) << "the sensors are silent";
  EXPECT_EQ(body->take_carrier_code(), code::none) << "the carrier is there";
  EXPECT_TRUE(has_logged("the autopilot does not say where it is"));
}

TEST_F(RoverBodyTest, DoesNotDriveByTheEstimatorsJumps) {
  set_off();
  auto const before = readings.back().odometry;
  rover->jump_m = 7.0;
  drive_for(500ms, ahead);
  EXPECT_LT(slam::distance_m(before, readings.back().odometry), 0.3);
  EXPECT_TRUE(has_logged("that is no motion"));
}

TEST_F(RoverBodyTest, LaysScansOfSeventyTwoDirections) {
  run_for(2s);
  ASSERT_FALSE(scans.empty());
  ASSERT_NE(body->sensor(), nullptr);
  auto const& bearings = body->sensor()->bearings_rad;
  auto const& ranges = scans.back().ranges_m;
  ASSERT_EQ(bearings.size(), 72U);
  auto const at = [&](float bearing) {
    auto const looks_there = [&](float each) { return std::abs(std::abs(each) - bearing) < 0.01F; };
    return ranges[static_cast<std::size_t>(std::ranges::find_if(bearings, looks_there) - bearings.begin())];
  };
  EXPECT_NEAR(at(1.5708F), 1.0, 0.05) << "the corridor's walls";
  EXPECT_NEAR(at(3.1416F), 1.0, 0.05) << "the corridor's end, behind";
}

TEST_F(RoverBodyTest, GivesAnEstimatorWithoutAnOriginTheSitesAnchor) {
  auto const anchor = geo::Wgs84::from_degrees(41.178, -8.598, 90.0);
  auto pipe = link::make_pipe(loop);
  testing::ScriptedRover indoors(loop, std::move(pipe.b), robot::testing::small_office());
  indoors.has_origin = false;
  RoverBody placed(loop, std::move(pipe.a), {.origin = anchor}, base::Logger());
  run_for(3s);
  EXPECT_FALSE(indoors.has_origin) << "it may find one by itself";
  run_for(7s);
  ASSERT_TRUE(indoors.has_origin);
  auto const given = indoors.all<mavlink::SetGpsGlobalOrigin>();
  ASSERT_EQ(given.size(), 1U);
  EXPECT_NEAR(given.front().position->lat_rad, anchor.lat_rad, 1e-9);
}

/// A rover among the vehicles.
struct AMavlinkRover : ::testing::Test {
  AMavlinkRover() {
    live_map.put_site(*geo::Site::make("office", geo::Wgs84::from_degrees(41.178, -8.598, 90.0)));
    auto pipe = link::make_pipe(loop);
    rover = std::make_unique<testing::ScriptedRover>(loop, std::move(pipe.b), robot::testing::small_office());
    RobotSpec spec{.id = "robot1", .name = "robot 1", .site = "office"};
    robot = platform.add(std::move(spec), std::make_unique<RoverBody>(loop, std::move(pipe.a), RoverBodyOptions{}, log))
                .value();
  }
  bool run_until(std::function<bool()> const& condition, base::Duration time) {
    auto const end = loop.now() + time;
    while (!condition() && loop.now() < end)
      loop.run_until_done([](base::Loop& on) -> base::Task<> { co_await on.sleep(100ms); }(loop));
    return condition();
  }

  base::LogHub hub;
  base::Loop loop{base::Loop::Pace{.unpaced = true, .begins_at = base::UtcTime(std::chrono::hours(24 * 365 * 30))}};
  base::Logger log{hub, "test"};
  vehicle::Registry registry{loop};
  vehicle::Authority authority{loop, registry, log};
  map::LiveMap live_map{[this] { return loop.utc_now(); }};
  RobotPlatform platform{{loop, registry, authority, live_map}, log};
  std::unique_ptr<testing::ScriptedRover> rover;
  Robot* robot = nullptr;
};

TEST_F(AMavlinkRover, ExploresTheOfficeAndComesBack) {
  ASSERT_TRUE(run_until([&] { return robot->is_connected(); }, 30s));
  auto const record = robot->start("Office", {ExploreStep{"tour"}, ReturnStep{}});
  ASSERT_TRUE(run_until([&] { return record->outcome != DriveRecord::Outcome::running; }, 30min));
  EXPECT_EQ(record->outcome, DriveRecord::Outcome::done) << record->error;
  EXPECT_EQ(rover->wheels().collisions(), 0);
  EXPECT_GT(robot->survey()->free_m2, 0.9 * robot::testing::small_office_m2);
  EXPECT_LT(std::hypot(rover->wheels().truth().x, rover->wheels().truth().y), 0.5);
}

TEST_F(AMavlinkRover, IsKilledAndRestartedByItsOperator) {
  ASSERT_TRUE(run_until([&] { return robot->is_connected(); }, 30s));
  auto const record = robot->start("Office", {ExploreStep{"tour"}});
  ASSERT_TRUE(run_until([&] { return !rover->stands(); }, 30s));
  robot->kill("emergency stop");
  ASSERT_TRUE(run_until([&] { return robot->is_killed() && robot->stands(); }, 3s));
  EXPECT_EQ(rover->mode, testing::hold);
  EXPECT_FALSE(rover->is_armed);
  ASSERT_TRUE(robot->restart());
  auto const again = robot->start("Office", {ExploreStep{"tour"}});
  EXPECT_TRUE(run_until([&] { return !rover->stands(); }, 10s));
}

}  // namespace
}  // namespace lapwing::robot::rover
