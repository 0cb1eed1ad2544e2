// On drawn grids: what is known beforehand is learnt as a whole, so that no sensor stands between.
#include "robot/planner/floor_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using State = Plan::State;

/// Free where `is_free(x, y)` in metres, taken elsewhere, within 4 m; unknown where `is_known(x, y)` does not hold.
template <class IsFree, class IsKnown>
map::OccupancyGrid drawn_in_part(IsFree const& is_free, IsKnown const& is_known) {
  map::OccupancyGrid grid(0.05);
  for (int y = -80; y < 80; ++y) {
    for (int x = -80; x < 80; ++x) {
      auto const at = grid.centre_of({x, y});
      if (!is_known(at.x(), at.y())) continue;
      grid.set({x, y}, map::Evidence::of_log_odds(is_free(at.x(), at.y()) ? -3.0 : 3.0));
    }
  }
  return grid;
}

template <class IsFree>
map::OccupancyGrid drawn(IsFree const& is_free, double known_to_x = 10.0) {
  return drawn_in_part(is_free, [&](double x, double) { return x <= known_to_x; });
}

void learn_all(FloorPlanner& planner, map::OccupancyGrid const& grid) {
  std::vector<map::TileKey> tiles;
  for (auto const& [key, tile] : grid.tiles()) tiles.push_back(key);
  planner.learn(grid, tiles);
}

bool in_room(double x, double y) {
  return std::abs(x) < 3.0 && std::abs(y) < 2.0;
}

TEST(FloorPlanner, DrivesToAPlaceOnFreeCellsAlone) {
  FloorPlanner planner(PlannerOptions{});
  // A wall across the room with a gap of 1 m at its upper end.
  auto const is_free = [](double x, double y) { return in_room(x, y) && (std::abs(x - 1.0) > 0.1 || y > 1.0); };
  learn_all(planner, drawn(is_free));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(2.0, 0.0)}));
  auto const plan = planner.plan({});
  ASSERT_EQ(plan.state, State::under_way);
  ASSERT_FALSE(plan.way.points.empty());
  EXPECT_TRUE(plan.way.is_to_the_end);
  double highest = 0.0;
  for (auto const& point : plan.way.points) {
    highest = std::max(highest, point.y());
    for (int i = 0; i < 21; ++i)
      EXPECT_TRUE(is_free(point.x() + 0.2 * std::cos(0.3 * i), point.y() + 0.2 * std::sin(0.3 * i)))
          << point.x() << ", " << point.y();
  }
  EXPECT_GT(highest, 1.2);
  EXPECT_EQ(planner.plan({.pose = {2.0, 0.0, 0.0}}).state, State::done);
}

TEST(FloorPlanner, GivesTheWayFromWhereTheRobotHasCome) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(2.5, 0.0)}));
  (void)planner.plan({.pose = {-2.5, 0.0, 0.0}});
  auto const later = planner.plan({.pose = {1.0, 0.0, 0.0}, .time_s = 12.0});
  ASSERT_FALSE(later.way.points.empty());
  EXPECT_NEAR(later.way.points.front().x(), 1.0, 0.1);
}

TEST(FloorPlanner, GoesAsideWhileACompanionAsksItToAndThenOn) {
  FloorPlanner planner(PlannerOptions{.id = "robot2"});
  auto const grid = drawn(in_room);
  learn_all(planner, grid);
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(2.5, 0.0)}));
  Companion other{.id = "robot1", .grid = grid, .pose = {0.0, 0.0, 0.0}, .explores = false};
  other.intent.asks = {{"robot2", Place(-2.0, 1.0)}};
  planner.meet({other}, grid);
  auto const aside = planner.plan({.pose = {-1.0, 0.0, 0.0}});
  ASSERT_FALSE(aside.way.points.empty());
  EXPECT_LT(geo::distance_m(aside.way.points.back(), Place(-2.0, 1.0)), 0.1);
  ASSERT_FALSE(aside.intent.way.empty()) << "it says where it wants to go on";
  EXPECT_NEAR(aside.intent.way.back().x(), 2.5, 0.1);
  EXPECT_TRUE(aside.intent.asks.empty()) << "another decides";
  // For as long as it takes: that does not count against its errand.
  for (double time_s = 1.0; time_s < 1000.0; time_s += 1.0)
    ASSERT_EQ(planner.plan({.pose = {-2.0, 1.0, 0.0}, .time_s = time_s}).state, State::under_way) << time_s;
  other.intent.asks.clear();
  planner.meet({other}, grid);
  auto const on = planner.plan({.pose = {-2.0, 1.0, 0.0}, .time_s = 1001.0});
  ASSERT_FALSE(on.way.points.empty());
  EXPECT_NEAR(on.way.points.back().x(), 2.5, 0.1);
}

TEST(FloorPlanner, AsksACompanionThatStandsInItsWayToMakeRoom) {
  // A corridor for one, with a room to its right at the far end.
  auto const is_free = [](double x, double y) {
    return (std::abs(x) < 3.5 && std::abs(y) < 0.5) || (x > 1.0 && x < 2.5 && y > -2.0 && y < 0.0);
  };
  FloorPlanner planner(PlannerOptions{.id = "robot1"});
  auto const grid = drawn(is_free);
  learn_all(planner, grid);
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(3.0, 0.0)}));
  planner.meet({{.id = "robot2", .grid = grid, .pose = {0.5, 0.0, 0.0}, .explores = false}}, grid);
  EXPECT_TRUE(planner.plan({.pose = {-0.2, 0.0, 0.0}}).intent.asks.empty()) << "it has not stood there yet";
  auto const plan = planner.plan({.pose = {-0.2, 0.0, 0.0}, .time_s = 6.0});
  ASSERT_TRUE(plan.intent.asks.contains("robot2"));
  EXPECT_LT(plan.intent.asks.at("robot2").y(), -0.5);
}

TEST(FloorPlanner, SaysWhyItCannotDriveThere) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(7.0, 0.0)}));
  auto const plan = planner.plan({});
  EXPECT_EQ(plan.state, State::failed);
  EXPECT_EQ(plan.reason, "its map shows no free place there: is it explored, and no wall?");
}

TEST(FloorPlanner, GoesAsNearAsOneCanStand) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(3.0, 0.0), .within_m = 1.0}));
  auto const plan = planner.plan({});
  ASSERT_EQ(plan.state, State::under_way);
  ASSERT_TRUE(plan.goal);
  EXPECT_NEAR(plan.goal->x(), 2.75, 0.1);
}

TEST(FloorPlanner, OfFewSensorsStandsOnceBeforeItSetsOut) {
  PlannerOptions options;
  options.looks_round = true;
  FloorPlanner planner(options);
  // What it has not seen of the room is its other half.
  learn_all(planner, drawn(in_room, 0.5));
  auto const sets_out = [&](double time_s) {
    auto const plan = planner.plan({.time_s = time_s});
    EXPECT_EQ(plan.state, State::under_way) << time_s;
    return plan.way.yaw_rad.has_value() || !plan.way.points.empty();
  };
  ASSERT_TRUE(planner.begin(ExploreErrand{}));
  EXPECT_FALSE(sets_out(100.0)) << "it learns its gyroscope's bias";
  EXPECT_FALSE(sets_out(110.0));
  EXPECT_TRUE(sets_out(116.0));
  ASSERT_TRUE(planner.begin(ExploreErrand{}));
  EXPECT_TRUE(sets_out(200.0)) << "it has stood";
}

TEST(FloorPlanner, TurnsWhereItHasComeToStandSoThatACameraLooksAtThePlace) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  constexpr double left_rad = 0.87;
  ASSERT_TRUE(planner.begin(LookErrand{.from = Place(2.0, 1.0), .at = Place(2.0, 2.0), .bearing_rad = left_rad}));
  auto const plan = planner.plan({});
  ASSERT_FALSE(plan.way.points.empty());
  EXPECT_NEAR(plan.way.points.back().x(), 2.0, 0.1);
  EXPECT_NEAR(plan.way.points.back().y(), 1.0, 0.1);
  auto const there = planner.plan({.pose = {2.0, 1.0, 0.0}, .time_s = 10.0});
  ASSERT_EQ(there.state, State::under_way);
  EXPECT_TRUE(there.way.points.empty()) << "it turns on the spot";
  EXPECT_EQ(there.way.speed_m_s, 0.0);
  ASSERT_TRUE(there.way.yaw_rad);
  EXPECT_NEAR(*there.way.yaw_rad, 1.5708 - left_rad, 0.01);
  EXPECT_EQ(planner.plan({.pose = {2.0, 1.0, 1.5708 - left_rad}, .time_s = 12.0}).state, State::done);
}

TEST(FloorPlanner, DoesNotWaitLongForAPlaceToLookFrom) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(LookErrand{.from = Place(2.0, 0.0), .at = Place(2.0, 2.0)}));
  Plan plan = planner.plan({});
  int time_s = 1;
  for (; time_s < 100 && plan.state == State::under_way; ++time_s) plan = planner.plan({.time_s = 1.0 * time_s});
  EXPECT_EQ(plan.state, State::failed);
  EXPECT_LT(time_s, 40);
  ASSERT_TRUE(planner.begin(LookErrand{.from = Place(7.0, 0.0), .at = Place(7.0, 2.0)}));
  EXPECT_EQ(planner.plan({.time_s = 101.0}).state, State::failed) << "nobody can stand there";
}

TEST(FloorPlanner, ExploresTowardsWhatIsUnknownAndIsDoneWithoutIt) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room, 1.5));
  ASSERT_TRUE(planner.begin(ExploreErrand{"nearest"}));
  auto const plan = planner.plan({});
  ASSERT_EQ(plan.state, State::under_way);
  ASSERT_TRUE(plan.goal);
  EXPECT_GT(plan.goal->x(), 0.5);
  auto const before = planner.survey();
  ASSERT_FALSE(before.frontiers.empty());
  EXPECT_NEAR(before.frontiers.front().x(), 1.5, 0.1);
  EXPECT_LT(before.coverage, 0.9);

  learn_all(planner, drawn(in_room));
  auto const after = planner.survey();
  EXPECT_TRUE(after.frontiers.empty());
  EXPECT_EQ(after.coverage, 1.0);
  EXPECT_NEAR(after.free_m2, 24.0, 0.5);
  State state = State::under_way;
  for (int i = 1; i < 20 && state == State::under_way; ++i) state = planner.plan({.time_s = 1.0 * i}).state;
  EXPECT_EQ(state, State::done);
}

TEST(FloorPlanner, DrivesAroundWhatStandsWhereItsMapIsFree) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(2.5, 0.0)}));
  Place const somebody(1.2, 0.0);
  auto const plan = planner.plan({.seen = {somebody}});
  ASSERT_FALSE(plan.way.points.empty());
  for (auto const& point : plan.way.points) EXPECT_GT(geo::distance_m(point, somebody), 0.25);
  auto const straight = planner.plan({.seen = {}});
  EXPECT_EQ(straight.state, State::under_way);
}

/// Nothing near, all around.
Room wide_room() {
  slam::Sensor sensor;
  sensor.bearings_rad = {-3.1F, 3.1F};
  sensor.no_return_m = 10.0F;
  slam::Scan scan;
  scan.ranges_m = {10.0F, 10.0F};
  return {scan, sensor};
}

TEST(FloorPlanner, GoesBackWhereItIsHeldUpAndThenAnotherWay) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(2.5, 0.0)}));
  EXPECT_GT(planner.plan({.time_s = 1.0}).way.speed_m_s, 0.0);
  EXPECT_FALSE(planner.plan({.time_s = 4.0, .room = wide_room()}).way.yaw_rad);
  auto const back = planner.plan({.time_s = 6.0, .room = wide_room()});
  EXPECT_LT(back.way.speed_m_s, 0.0);
  EXPECT_EQ(back.way.yaw_rad, 0.0);
  auto const again = planner.plan({.pose = {-0.25, 0.0, 0.0}, .time_s = 8.0, .room = wide_room()});
  ASSERT_FALSE(again.way.points.empty());
  Place const bump(0.3, 0.0);
  for (auto const& point : again.way.points) EXPECT_GT(geo::distance_m(point, bump), 0.2);
}

TEST(FloorPlanner, KeepsOffWhatItsLaserShowsWhereItIsHeldUp) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(2.5, 0.0)}));
  Place const jamb(0.15, 0.2);  // beside where it looks, and so near that no disc around it would let a way begin
  for (double const time_s : {0.0, 3.0, 6.0})
    (void)planner.plan({.time_s = time_s, .seen = {jamb}, .room = wide_room()});
  auto const again = planner.plan({.pose = {-0.25, 0.0, 0.0}, .time_s = 8.0, .room = wide_room()});
  ASSERT_FALSE(again.way.points.empty());
  double lowest = 0.0;
  for (auto const& point : again.way.points) lowest = std::min(lowest, point.y());
  EXPECT_LT(lowest, -0.05) << "on the other side of it";
}

TEST(FloorPlanner, GoesHomeAsItCameWhereItsMapHasClosedTheWay) {
  FloorPlanner planner(PlannerOptions{});
  // A doorway that is drawn 30 cm wide.
  auto const is_free = [](double x, double y) {
    return in_room(x, y) && (std::abs(x - 1.0) > 0.1 || std::abs(y) < 0.15);
  };
  learn_all(planner, drawn(is_free));
  ASSERT_TRUE(planner.begin(ReturnErrand{}));
  EXPECT_TRUE(planner.plan({.pose = {2.0, 0.0, 0.0}}).way.points.empty());
  std::vector<slam::Pose2> driven;
  for (int i = 0; i <= 10; ++i) driven.push_back({0.2 * i, 0.0, 0.0});
  auto const plan = planner.plan({.pose = {2.0, 0.0, 0.0}, .time_s = 1.0, .driven = driven});
  ASSERT_FALSE(plan.way.points.empty());
  EXPECT_LT(plan.way.points.back().x(), 0.2);
  for (auto const& point : plan.way.points) {
    if (std::abs(point.x() - 1.0) > 0.3) continue;
    EXPECT_NEAR(point.y(), 0.0, 0.1);
  }
}

TEST(FloorPlanner, LeavesTheReachOfAWallToBeginAWay) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(0.0, 0.0)}));
  std::array constexpr driven{slam::Pose2{2.0, 0.0, 0.0}, slam::Pose2{2.5, 0.0, 0.0}};
  auto const plan = planner.plan({.pose = {2.9, 0.0, 0.0}, .driven = driven});
  EXPECT_EQ(plan.state, State::under_way);
  ASSERT_FALSE(plan.way.points.empty());
  EXPECT_LT(plan.way.points.back().x(), 2.75);
}

// Behind a desk there is hardly room: from cell to cell its nose would point another way each time.
TEST(FloorPlanner, LooksAheadWhereItHardlyFits) {
  FloorPlanner planner(PlannerOptions{});
  // A passage of 0.5 m; the robot is 0.36 m wide and may stand where 0.56 m are free.
  learn_all(planner, drawn([](double x, double y) { return in_room(x, y) && (x > 1.0 || std::abs(y) < 0.25); }));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(2.0, 0.0)}));
  auto const plan = planner.plan({.pose = {-0.5, 0.02, 0.0}});
  ASSERT_EQ(plan.state, State::under_way);
  EXPECT_GE(plan.way.clear_to, 8U) << "of 5 cm";
}

TEST(FloorPlanner, GivesUpWhenItDoesNotGetOn) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(2.0, 0.0)}));
  EXPECT_EQ(planner.plan({.time_s = 100.0}).state, State::under_way);
  // To and fro is not on.
  for (int time_s = 101; time_s < 280; ++time_s)
    ASSERT_EQ(planner.plan({.pose = {time_s < 190 ? -0.1 : 0.0, 0.0, 0.0}, .time_s = 1.0 * time_s}).state,
              State::under_way)
        << time_s;
  auto const plan = planner.plan({.time_s = 281.0});
  EXPECT_EQ(plan.state, State::failed);
  EXPECT_EQ(plan.reason, "it has not got on for 181 s: something stands in its way");
}

TEST(FloorPlanner, LeavesAPlaceAtWhoseSideNothingIsKnown) {
  // Of a quarter behind it, or ahead of it, its scanner says nothing.
  for (double const blind_rad : {0.0, 3.14}) {
    FloorPlanner planner(PlannerOptions{});
    auto const is_known = [&](double x, double y) {
      return std::abs(geo::wrap_pi(std::atan2(y, x) - blind_rad)) > 0.78;
    };
    learn_all(planner, drawn_in_part(in_room, is_known));
    ASSERT_TRUE(planner.begin(ExploreErrand{"nearest"}));
    Plan plan = planner.plan({});
    // What is unknown right beside it, it looks at from where it stands.
    for (int time_s = 1; time_s < 20 && plan.way.points.empty(); ++time_s)
      plan = planner.plan({.time_s = 1.0 * time_s});
    EXPECT_EQ(plan.state, State::under_way) << blind_rad << ": " << plan.reason;
    EXPECT_FALSE(plan.way.points.empty()) << blind_rad;
  }
}

TEST(FloorPlanner, EndsAnExplorationThatDoesNotGetOnAndSaysWhatIsLeft) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room, 1.5));
  ASSERT_TRUE(planner.begin(ExploreErrand{"nearest"}));
  Plan plan;
  int time_s = 0;
  for (; time_s < 600 && plan.state != State::done && plan.state != State::failed; ++time_s)
    plan = planner.plan({.time_s = 1.0 * time_s});
  EXPECT_EQ(plan.state, State::done);
  EXPECT_LT(time_s, 200);
  EXPECT_EQ(plan.reason, "2 places are left unseen: it could not get to see them");
  EXPECT_LT(planner.survey().coverage, 0.9);
}

TEST(FloorPlanner, CountsAsUnseenWhatItCannotReach) {
  FloorPlanner planner(PlannerOptions{});
  // A large room that is seen through a gap of 30 cm.
  auto const is_free = [](double x, double y) {
    return std::abs(x) < 3.9 && std::abs(y) < 3.9 && (std::abs(x + 3.0) > 0.1 || std::abs(y) < 0.15);
  };
  learn_all(planner, drawn(is_free, 3.5));
  ASSERT_TRUE(planner.begin(ExploreErrand{"nearest"}));
  Plan plan;
  for (int i = 0; i < 20 && plan.state != State::done; ++i)
    plan = planner.plan({.pose = {-3.5, 0.0, 0.0}, .time_s = 1.0 * i});
  EXPECT_EQ(plan.state, State::done);
  EXPECT_NE(plan.reason.find("left unseen"), std::string::npos) << plan.reason;
  EXPECT_LT(planner.survey().coverage, 0.97);
  EXPECT_FALSE(planner.survey().frontiers.empty());
}

TEST(FloorPlanner, ReturnsToWhereItsMapBegins) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  ASSERT_TRUE(planner.begin(ReturnErrand{}));
  auto const plan = planner.plan({.pose = {2.0, 1.0, 0.0}});
  ASSERT_EQ(plan.state, State::under_way);
  EXPECT_NEAR(plan.goal->x(), 0.0, 0.05);
  EXPECT_NEAR(plan.goal->y(), 0.0, 0.05);
}

TEST(FloorPlanner, StandsWithoutAnErrandAndRefusesAStrategyThatThereIsNot) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, drawn(in_room));
  EXPECT_EQ(planner.plan({}).state, State::idle);
  EXPECT_EQ(planner.begin(ExploreErrand{"left-hand"}).error().message, "there is no strategy `left-hand`");
}

/// A corridor along x, known as far as that.
map::OccupancyGrid corridor(double from_x, double to_x, double known_to_x) {
  map::OccupancyGrid grid(0.05);
  for (int x = static_cast<int>(from_x / 0.05) - 4; x < static_cast<int>(std::min(to_x + 0.2, known_to_x) / 0.05);
       ++x) {
    for (int y = -20; y < 20; ++y) {
      auto const at = grid.centre_of({x, y});
      bool const is_free = std::abs(at.y()) < 0.8 && at.x() > from_x && at.x() < to_x;
      grid.set({x, y}, map::Evidence::of_log_odds(is_free ? -3.0 : 3.0));
    }
  }
  return grid;
}

TEST(FloorPlanner, PlansAsFarAsItsMapGoes) {
  FloorPlanner planner(PlannerOptions{});
  learn_all(planner, corridor(-60.0, 90.0, 100.0));
  ASSERT_TRUE(planner.begin(DriveErrand{.to = Place(88.0, 0.0)}));
  auto const plan = planner.plan({.pose = {80.0, 0.0, 0.0}});
  ASSERT_EQ(plan.state, State::under_way);
  ASSERT_FALSE(plan.way.points.empty());
  EXPECT_GT(plan.way.points.back().x(), 85.0);
  EXPECT_NEAR(planner.home_m({80.0, 0.0}), 80.0, 2.0);
  EXPECT_NEAR(planner.home_m({-58.0, 0.0}), 58.0, 2.0);
}

TEST(FloorPlanner, GoesOnExploringWhereItsMapGrowsBeyondWhatItPlannedIn) {
  FloorPlanner planner(PlannerOptions{});
  ASSERT_TRUE(planner.begin(ExploreErrand{.strategy = "nearest"}));
  double time_s = 0.0;
  for (double known_to_x = 5.0; known_to_x < 70.0; known_to_x += 5.0) {
    learn_all(planner, corridor(-1.0, 70.0, known_to_x));
    auto const plan = planner.plan({.pose = {known_to_x - 3.0, 0.0, 0.0}, .time_s = time_s += 10.0});
    ASSERT_EQ(plan.state, State::under_way) << known_to_x;
    ASSERT_TRUE(plan.goal) << known_to_x;
    EXPECT_NEAR(plan.goal->x(), known_to_x, 1.0);
  }
  learn_all(planner, corridor(-1.0, 70.0, 80.0));
  EXPECT_EQ(planner.plan({.pose = {67.0, 0.0, 0.0}, .time_s = time_s + 10.0}).state, State::done);
  EXPECT_EQ(planner.survey().coverage, 1.0);
}

TEST(FloorPlanner, SaysThatTheFloorGoesOnBeyondWhereItPlans) {
  FloorPlanner planner(PlannerOptions{});
  auto grid = drawn(in_room);
  grid.set({2'000'000, 0}, map::Evidence::of_log_odds(-3.0));
  learn_all(planner, grid);
  ASSERT_TRUE(planner.begin(ExploreErrand{.strategy = "nearest"}));
  auto const plan = planner.plan({});
  EXPECT_EQ(plan.state, State::done);
  EXPECT_EQ(plan.reason, "the floor goes on beyond the 51 by 51 m in which it plans");
}

TEST(FloorPlanner, WaitsForItsCompanionsWhereItIsAndThenAtHomeEachTimeThatItExplores) {
  FloorPlanner planner({.id = "robot1"});
  auto const room = drawn(in_room);
  auto const at = [&](double time_s) {
    return planner.plan({.pose = {2.0, 0.0, 0.0}, .driven_m = 9.0, .time_s = time_s});
  };
  auto const meet = [&](bool waits) {
    learn_all(planner, room);
    planner.meet({{.id = "robot2", .grid = map::OccupancyGrid(0.05), .waits = waits}}, room);
  };
  for (double const begun_s : {0.0, 100.0}) {
    ASSERT_TRUE(planner.begin(ExploreErrand{}));
    meet(false);
    auto const stands_by = at(begun_s + 1.0);
    EXPECT_EQ(stands_by.state, State::under_way);
    EXPECT_TRUE(stands_by.waits);
    EXPECT_TRUE(stands_by.way.points.empty()) << begun_s;
    auto const goes_home = at(begun_s + 35.0);
    EXPECT_TRUE(goes_home.waits);
    ASSERT_FALSE(goes_home.way.points.empty());
    EXPECT_LT(goes_home.way.points.back().x(), 1.0);
    meet(true);
    EXPECT_EQ(at(begun_s + 40.0).state, State::done) << "all wait";
  }
}

}  // namespace
}  // namespace lapwing::robot
