// Robots in a simulated office, mapped from their laser and wheels alone.
#include "robot/platform/robot_platform.hpp"

#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "robot/testing/platform_bench.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
using tasks::RunState;

struct RobotPlatformTest : ::testing::Test, testing::PlatformBench {
  void SetUp() override {
    ASSERT_TRUE(run_until([this] { return robot->here().has_value(); }, 5s));
  }
  /// From a place to the nearest wall on the map.
  [[nodiscard]] double from_walls_m(Eigen::Vector2d const& place) const {
    double nearest_m = 1e9;
    for (auto const* found : live_map.within(map::LayerKind::walls, "office", std::nullopt, 1000)) {
      auto const& ends = std::get<map::Wall>(found->feature.content).line.points;
      Eigen::Vector2d const way = ends[1].v - ends[0].v;
      double const share = std::clamp((place - ends[0].v).dot(way) / way.squaredNorm(), 0.0, 1.0);
      nearest_m = std::min(nearest_m, (ends[0].v + share * way - place).norm());
    }
    return nearest_m;
  }
  /// How far its own belief is from where it stands.
  [[nodiscard]] double error_m() const { return slam::distance_m(robot->here()->pose, body->truth()); }
};

TEST_F(RobotPlatformTest, WithoutEyesPhotographsNothingAndSaysSo) {
  auto const run = start({PhotographStep{}, WaitStep{1.0}});
  ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 1min)) << run->progress();
  EXPECT_EQ(run->state(), RunState::done) << run->error();
  EXPECT_EQ(robot->drives().back()->remark, "photograph: nobody looks through its camera here");
}

TEST_F(RobotPlatformTest, MapsTheWholeFloorAndComesBack) {
  auto const run = start({ExploreStep{"tour"}, ReturnStep{}});
  ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 30min)) << run->progress();
  EXPECT_EQ(run->state(), RunState::done) << run->error();
  EXPECT_EQ(body->collisions(), 0);
  EXPECT_LT(std::hypot(body->truth().x, body->truth().y), 0.6) << "where it began";
  EXPECT_LT(error_m(), 0.15);
  EXPECT_GE(robot->survey()->coverage, 0.98);
  EXPECT_NEAR(robot->survey()->free_m2, testing::small_office_m2, 0.06 * testing::small_office_m2);
  EXPECT_EQ(state().mode.value, "HOLD");

  ASSERT_EQ(live_map.grids().size(), 1u);
  auto const& [key, record] = *live_map.grids().begin();
  EXPECT_EQ(key.name, "robot 1");
  EXPECT_EQ(record.account.writer, "robot1");
  EXPECT_LT(record.grid.at(record.grid.cell_at({6.0, 0.0})).probability(), 0.2) << "the corridor";
  EXPECT_TRUE(robot->survey()->frontiers.empty());

  // Where walls were drawn some were found.
  for (auto const& [from, to] : testing::small_office()) EXPECT_LT(from_walls_m(0.5 * (from + to)), 0.1) << from << to;
}

TEST_F(RobotPlatformTest, ExploresWithAScannerThatLooksNoWayBack) {
  // Most scanners see three quarters of a circle, some a half, from the middle or the front of the robot.
  struct Looks {
    double view_rad;
    double laser_x_m;
  };
  for (auto const [view_rad, laser_x_m] :
       {Looks{1.5 * std::numbers::pi, 0.0}, {std::numbers::pi, 0.0}, {std::numbers::pi, 0.15}}) {
    auto const id = fmt::format("robot{:.0f}", 100.0 * view_rad + 1000.0 * laser_x_m);
    auto* const other = add(id, {.beams = 270, .view_rad = view_rad, .laser_x_m = laser_x_m});
    ASSERT_TRUE(run_until([&] { return other->here().has_value(); }, 5s));
    auto const run = start({ExploreStep{"tour"}, ReturnStep{}}, id);
    ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 30min)) << run->progress();
    EXPECT_EQ(run->state(), RunState::done) << run->error();
    EXPECT_GE(other->survey()->coverage, 0.95) << view_rad << ": " << other->drives().back()->remark;
    EXPECT_GE(other->survey()->free_m2, 0.9 * testing::small_office_m2) << view_rad << ", " << laser_x_m;
  }
}

TEST_F(RobotPlatformTest, KeepsOffWallsByHowLargeItIs) {
  auto* const large = add("robot30", {.radius_m = 0.3});
  ASSERT_TRUE(run_until([&] { return large->here().has_value(); }, 5s));
  auto const run = start({ExploreStep{"tour"}, ReturnStep{}}, "robot30");
  ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 30min)) << run->progress();
  EXPECT_EQ(run->state(), RunState::done) << run->error();
  EXPECT_GE(large->survey()->coverage, 0.98) << "doors are 90 cm wide";
  EXPECT_EQ(added_body->collisions(), 0);
}

TEST_F(RobotPlatformTest, SharesAFloorWithWhoeverExploresItToo) {
  auto const alone = start({ExploreStep{"nearest"}});
  ASSERT_TRUE(run_until([&] { return alone->state() != RunState::in_progress; }, 30min)) << alone->progress();
  double const alone_m = body->driven_m();

  testing::PlatformBench both;
  // At the corridor's other end, and turned about: its own map lies the other way round.
  slam::Pose2 const there{12.0, 0.0, std::numbers::pi};
  auto* const other = both.add("robot2", {.start = there}, {}, {{there.x, there.y}, there.yaw});
  ASSERT_TRUE(both.run_until([&] { return both.robot->here() && other->here(); }, 5s));
  auto const one = both.start({ExploreStep{"nearest"}, ReturnStep{}});
  auto const two = both.start({ExploreStep{"nearest"}, ReturnStep{}}, "robot2");
  auto const have_ended = [&] {
    return one->state() != RunState::in_progress && two->state() != RunState::in_progress;
  };
  ASSERT_TRUE(both.run_until(have_ended, 30min)) << one->progress() << "; " << two->progress();
  EXPECT_EQ(one->state(), RunState::done) << one->error();
  EXPECT_EQ(two->state(), RunState::done) << two->error();
  EXPECT_EQ(both.body->collisions() + both.added_body->collisions(), 0);
  // Each has the whole floor, of which it has seen a part itself.
  for (auto const* robot : {both.robot, other}) {
    EXPECT_GE(robot->survey()->coverage, 0.97) << robot->spec().id;
    EXPECT_NEAR(robot->survey()->free_m2, testing::small_office_m2, 0.08 * testing::small_office_m2);
  }
  EXPECT_LT(both.body->driven_m(), 0.8 * alone_m);
  EXPECT_LT(both.added_body->driven_m(), 0.8 * alone_m);
}

TEST_F(RobotPlatformTest, ExploresAgainWhatOthersHaveSeenWhenItIsToldTo) {
  auto* const other = add("robot2", {.start = {12.0, 0.0, std::numbers::pi}}, {}, {{12.0, 0.0}, std::numbers::pi});
  ASSERT_TRUE(run_until([&] { return other->here().has_value(); }, 5s));
  auto const one = start({ExploreStep{"nearest"}});
  auto const two = start({ExploreStep{"nearest"}}, "robot2");
  ASSERT_TRUE(
      run_until([&] { return one->state() != RunState::in_progress && two->state() != RunState::in_progress; }, 30min));
  double const shared_m = body->driven_m();
  auto const again = start({ExploreStep{"nearest"}});
  ASSERT_TRUE(run_until([&] { return again->state() != RunState::in_progress; }, 30min));
  EXPECT_GT(body->driven_m(), shared_m + 5.0) << "what the other has seen it looks at now";
  EXPECT_NEAR(robot->survey()->free_m2, testing::small_office_m2, 0.06 * testing::small_office_m2);
}

TEST_F(RobotPlatformTest, KnowsNothingOfTheMapOfARobotThatIsSaidToStandWhereItDoes) {
  auto* const other = add("robot2", {.start = {12.0, 0.0, std::numbers::pi}});
  ASSERT_TRUE(run_until([&] { return other->here().has_value(); }, 5s));
  auto const one = start({ExploreStep{"nearest"}});
  auto const two = start({ExploreStep{"nearest"}}, "robot2");
  ASSERT_TRUE(run_until([&] { return one->state() != RunState::in_progress; }, 30min));
  EXPECT_GE(robot->survey()->coverage, 0.97);
  EXPECT_NEAR(robot->survey()->free_m2, testing::small_office_m2, 0.06 * testing::small_office_m2);
}

TEST_F(RobotPlatformTest, PassesWhoeverComesTowardsItWhereThereIsRoomForOneAlone) {
  walls = testing::narrow_corridor();
  slam::Pose2 const there{8.0, 0.0, std::numbers::pi};
  auto* const left = add("robot2");
  auto* const left_body = added_body;
  auto* const right = add("robot3", {.start = there}, {}, {{there.x, there.y}, there.yaw});
  auto* const right_body = added_body;
  ASSERT_TRUE(run_until([&] { return left->here() && right->here(); }, 5s));
  for (auto const* id : {"robot2", "robot3"}) {
    auto const run = start({ExploreStep{"nearest"}, ReturnStep{}}, id);
    ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 5min)) << run->progress();
  }
  left_body->others_there = {right_body};
  right_body->others_there = {left_body};
  auto const* const site = live_map.site("office");
  auto const place = [&](double x) { return site->place_of(geo::Point3<geo::SiteFrame>(x, 0.0, 0.0)); };
  auto const one = start({DriveToPlaceStep{place(8.0)}}, "robot2");
  auto const two = start({DriveToPlaceStep{place(0.0)}}, "robot3");
  auto const have_ended = [&] {
    return one->state() != RunState::in_progress && two->state() != RunState::in_progress;
  };
  ASSERT_TRUE(run_until(have_ended, 10min)) << one->progress() << "; " << two->progress();
  EXPECT_EQ(one->state(), RunState::done) << one->error();
  EXPECT_EQ(two->state(), RunState::done) << two->error();
  EXPECT_EQ(left_body->collisions() + right_body->collisions(), 0);
  EXPECT_NEAR(left_body->truth().x, 8.0, 0.5);
  EXPECT_NEAR(right_body->truth().x, 0.0, 0.5);
}

TEST_F(RobotPlatformTest, ExploresWithFourRangers) {
  auto* const other = add("robot4", {.beams = 4, .laser_m = 4.0});
  ASSERT_TRUE(run_until([&] { return other->here().has_value(); }, 5s));
  auto const run = start({ExploreStep{"nearest"}, ReturnStep{}}, "robot4");
  ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 60min)) << run->progress();
  EXPECT_EQ(run->state(), RunState::done) << run->error();
  EXPECT_GE(other->survey()->free_m2, 0.9 * testing::small_office_m2) << other->drives().back()->remark;
}

TEST_F(RobotPlatformTest, EndsAnExplorationWhileItsBatteryTakesItHome) {
  body->battery = 0.5;
  body->drain_per_s = 1.0 / 300.0;
  auto const run = start({ExploreStep{"tour"}, ReturnStep{}});
  ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 30min)) << run->progress();
  EXPECT_EQ(run->state(), RunState::done) << run->error();
  EXPECT_TRUE(robot->drives().back()->remark.starts_with("explore: its battery takes it home and little farther: "))
      << robot->drives().back()->remark;
  EXPECT_LT(robot->survey()->coverage, 0.95) << "there was more to see";
  EXPECT_LT(std::hypot(body->truth().x, body->truth().y), 0.6) << "where it began";
  EXPECT_GT(body->battery, 0.05) << "the margin";
}

TEST_F(RobotPlatformTest, DrivesToAPlaceWhateverItsBatterySays) {
  body->battery = 0.1;
  auto const& site = *live_map.site("office");
  auto const run = start({DriveToPlaceStep{site.place_of(geo::Point3<geo::SiteFrame>(4.0, 0.0, 0.0))}});
  ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 5min)) << run->progress();
  EXPECT_EQ(run->state(), RunState::done) << run->error();
  EXPECT_NEAR(body->truth().x, 4.0, 0.5);
}

TEST_F(RobotPlatformTest, PutsWallsWhereTheRobotStartsInItsSite) {
  RobotSpec spec{.id = "robot2", .name = "robot 2", .site = "office", .start = {{50.0, -30.0}, 1.0}};
  auto const turned = platform.add(
      spec, std::make_unique<testing::SimpleBody>(loop, testing::small_office(), testing::SimpleBodyOptions{}));
  ASSERT_TRUE(turned);
  ASSERT_TRUE(run_until([&] { return (*turned)->here().has_value(); }, 5s));
  auto const run = start({ExploreStep{"nearest"}}, "robot2");
  run_for(20s);
  geo::Transform<geo::SiteFrame, map::GridFrame> const site_from_map(spec.start.position, spec.start.yaw_rad);
  int found = 0;
  for (auto const& [from, to] : testing::small_office()) {
    Eigen::Vector2d const middle = 0.5 * (from + to);
    found += from_walls_m((site_from_map * Place(middle.x(), middle.y())).v) < 0.1 ? 1 : 0;
  }
  EXPECT_GT(found, 1) << "those that it has seen by now";
}

TEST_F(RobotPlatformTest, ShowsWhereItIsAndHowSureOfIt) {
  auto const run = start({ExploreStep{"nearest"}});
  run_for(20s);
  EXPECT_EQ(state().family, vehicle::Family::robot);
  EXPECT_EQ(state().mode.value, "EXPLORE");
  auto const& pose = *state().motion.site_pose.value;
  EXPECT_EQ(pose.site, "office");
  EXPECT_NEAR(pose.position.x(), body->truth().x, 0.2);
  EXPECT_GT(robot->spread()->minor_m, 0.0);
  EXPECT_LT(robot->spread()->major_m, 0.2);
  EXPECT_FALSE(robot->way().empty());
  EXPECT_FALSE(robot->survey()->frontiers.empty());
  auto const info = *platform.find({"robot1"});
  EXPECT_EQ(info.type, "UGV");
  EXPECT_NEAR(info.position->lat_deg(), 41.178, 0.001);
  EXPECT_GT(*info.coverage, 0.0);
  EXPECT_LT(*info.coverage, 1.0);
  EXPECT_NE(run->progress().find("explore, "), std::string::npos) << run->progress();
  EXPECT_EQ(state().control.commander, vehicle::script_commander);
}

TEST_F(RobotPlatformTest, DrivesToPlacesByPositionAndByName) {
  auto exploring = start({ExploreStep{"tour"}});
  ASSERT_TRUE(run_until([&] { return exploring->state() != RunState::in_progress; }, 30min));
  auto const& site = *live_map.site("office");
  ASSERT_TRUE(live_map.put({.id = "door 221",
                            .site = "office",
                            .account = {.writer = "test", .at = loop.utc_now()},
                            .content = map::PointOfInterest{.position = {10.0, 2.5}, .kind = "door", .name = "221"}}));
  auto const place = site.place_of(geo::Point3<geo::SiteFrame>(5.5, -2.5, 0.0));
  auto const run = start({DriveToPlaceStep{place}, WaitStep{1.0}});
  ASSERT_TRUE(run_until([&] { return run->state() != RunState::in_progress; }, 5min));
  EXPECT_EQ(run->state(), RunState::done) << run->error();
  EXPECT_LT(std::hypot(body->truth().x - 5.5, body->truth().y + 2.5), 0.3);
  auto const named = start({DriveToNameStep{"room 221"}});
  ASSERT_TRUE(run_until([&] { return named->state() != RunState::in_progress; }, 5min));
  EXPECT_LT(std::hypot(body->truth().x - 10.0, body->truth().y - 2.5), 0.3);
  auto const nowhere = start({DriveToNameStep{"room 999"}});
  run_for(1s);
  EXPECT_EQ(nowhere->error(), "drive to room 999: the map has no place called 'room 999' on its floor");
  EXPECT_EQ(body->collisions(), 0);
}

TEST_F(RobotPlatformTest, StandsWhenTheScriptStopsIt) {
  auto const run = start({ExploreStep{"tour"}});
  ASSERT_TRUE(run_until([this] { return body->driven_m() > 1.0; }, 1min));
  run->stop();
  loop.run_until_done(platform.settle());
  EXPECT_TRUE(robot->stands());
  EXPECT_EQ(state().control.commander, "");
  auto const stood_at = body->truth();
  run_for(5s);
  EXPECT_EQ(body->truth(), stood_at);
}

TEST_F(RobotPlatformTest, IsWaitedForNoLongerOnceItIsLost) {
  platform.set_connection_timeout({"robot1"}, 3s);
  auto const run = start({ExploreStep{"tour"}});
  ASSERT_TRUE(run_until([this] { return body->driven_m() > 1.0; }, 1min));
  body->is_silent = true;
  run->stop();
  auto settling = platform.settle();
  settling.start();
  run_for(2s);
  EXPECT_FALSE(settling.done()) << "it may be heard again";
  EXPECT_EQ(platform.unsettled(), std::vector<std::string>{"robot 1"});
  ASSERT_TRUE(run_until([&] { return settling.done(); }, 10s));
  EXPECT_TRUE(platform.unsettled().empty());
  EXPECT_EQ(state().control.commander, "");
}

TEST_F(RobotPlatformTest, IsNotSeenStandingByWhatWasToldBeforeItDrove) {
  auto const run = start({ExploreStep{"tour"}});
  ASSERT_TRUE(run_until([this] { return body->is_asked_to_move(); }, 1min));
  body->is_silent = true;
  run->stop();
  run_for(1s);
  EXPECT_EQ(platform.unsettled(), std::vector<std::string>{"robot 1"}) << "its last reading is from when it stood";
}

TEST_F(RobotPlatformTest, GoesToAnotherTaskWithoutStanding) {
  auto const first = start({ExploreStep{"tour"}});
  ASSERT_TRUE(run_until([this] { return body->driven_m() > 2.0; }, 1min));
  first->stop();
  auto const second = start({ReturnStep{}});
  ASSERT_TRUE(run_until([&] { return second->state() != RunState::in_progress; }, 2min));
  EXPECT_EQ(second->state(), RunState::done) << second->error();
  EXPECT_LT(std::hypot(body->truth().x, body->truth().y), 0.6);
}

TEST_F(RobotPlatformTest, StandsWhenItsLaserFallsSilent) {
  auto const run = start({ExploreStep{"tour"}});
  ASSERT_TRUE(run_until([this] { return body->driven_m() > 1.0; }, 1min));
  body->is_blind = true;
  run_for(3s);
  auto const stood_at = body->truth();
  run_for(5s);
  EXPECT_EQ(body->truth(), stood_at) << "nobody drives by what was seen long ago";
  body->is_blind = false;
  run_for(10s);
  EXPECT_NE(body->truth(), stood_at);
}

TEST_F(RobotPlatformTest, FailsTheTaskOfARobotThatIsLost) {
  platform.set_connection_timeout({"robot1"}, 3s);
  auto const run = start({ExploreStep{"tour"}});
  run_for(5s);
  body->is_silent = true;
  run_for(6s);
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_TRUE(run->vehicle_failed());
  EXPECT_EQ(run->error(), "robot 1 is lost");
  EXPECT_EQ(state().links.connection, vehicle::Connection::lost);
  EXPECT_FALSE(platform.find({"robot1"})->connected);
  EXPECT_TRUE(start({ReturnStep{}})->vehicle_failed());
  body->is_silent = false;
  run_for(3s);
  EXPECT_EQ(state().links.connection, vehicle::Connection::ok);
}

TEST_F(RobotPlatformTest, StopsBeforeWhoStandsInItsWay) {
  auto const run = start({ExploreStep{"tour"}});
  // Right across the corridor, 1.5 m ahead of wherever it is going along it.
  ASSERT_TRUE(run_until([this] { return body->truth().x > 1.0 && std::abs(body->truth().yaw) < 0.2; }, 3min));
  double const x = body->truth().x + 1.0;
  body->put_in_the_way = {{{x, -1.0}, {x, 1.0}}};
  run_for(20s);
  EXPECT_EQ(body->collisions(), 0);
  EXPECT_EQ(run->state(), RunState::in_progress);
}

TEST_F(RobotPlatformTest, LeavesARobotToWhoeverCommandsIt) {
  ASSERT_TRUE(authority.claim({"robot1"}, "anna"));
  auto const refused = start({ReturnStep{}});
  EXPECT_EQ(refused->error(), "robot 1 is commanded by anna");
  (void)authority.yield({"robot1"}, "anna");
  auto const run = start({ExploreStep{"tour"}});
  run_for(5s);
  authority.take({"robot1"}, "ben");
  EXPECT_EQ(run->state(), RunState::failed);
  EXPECT_EQ(run->error(), "ben took robot 1 over");
}

TEST_F(RobotPlatformTest, RefusesWhatIsNoDriveAndRobotsThatCannotBe) {
  class Other final : public tasks::PlatformTask {
    [[nodiscard]] std::string name() const override { return "survey"; }
    [[nodiscard]] std::optional<std::string> unsuited(tasks::VehicleInfo const&) const override { return std::nullopt; }
    [[nodiscard]] std::optional<geo::Wgs84> reference_position() const override { return std::nullopt; }
  };
  auto const other = std::make_shared<Other const>();
  EXPECT_EQ(platform.unsuited(*other, *platform.find({"robot1"})), "survey is no drive");
  EXPECT_EQ(platform.start(other, {"robot1"})->error(), "'survey' is no drive: robot 1 cannot do it");
  EXPECT_EQ(platform.start(other, {"nobody"})->error(), "no robot nobody");
  auto body_again = [this] {
    return std::make_unique<testing::SimpleBody>(loop, testing::small_office(), testing::SimpleBodyOptions{});
  };
  EXPECT_EQ(platform.add({.id = "robot1", .site = "office"}, body_again()).error().message,
            "there are two robots called robot1");
  EXPECT_EQ(platform.add({.id = "robot2", .site = "nowhere"}, body_again()).error().message,
            "robot2: the map has no site nowhere");
  EXPECT_EQ(platform.add({.id = "robot2", .site = "office", .floor = "9"}, body_again()).error().message,
            "robot2: the site office has no floor 9");
}

TEST(RobotPlatform, GivesTheSameRunOnOneThreadAndOnMany) {
  auto const truth_after = [](unsigned threads) {
    testing::PlatformBench bench(threads);
    bench.run_until([&] { return bench.robot->here().has_value(); }, 5s);
    auto const run = bench.start({ExploreStep{"tour"}});
    bench.run_for(60s);
    return bench.body->truth();
  };
  EXPECT_EQ(truth_after(1), truth_after(4));
}

}  // namespace
}  // namespace lapwing::robot
