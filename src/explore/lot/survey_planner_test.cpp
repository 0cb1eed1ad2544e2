#include "explore/lot/survey_planner.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "explore/testing/lot_pictures.hpp"

namespace lapwing::explore {
namespace {

using testing::after;
using testing::lot_map;
using testing::sight_at;
using testing::slot_at;

SurveySettings standard() {
  constexpr double across_rad = 1.08;
  SurveySettings settings;
  settings.camera = geo::pinhole(1280, 720, across_rad);
  return settings;
}

SurveyPlanner planner_of(SurveySettings const& settings = standard()) {
  return SurveyPlanner::make({{{{-5, -5}, {65, -5}, {65, 45}, {-5, 45}}}}, settings).value();
}

SurveyDrone const start = {.place = {5.0, 5.0, 10.0}};
SurveyBudget const plenty = {.home = {5.0, 5.0}};

SurveyStep step_of(SurveyPlanner const& planner, LotMap const& lot, SurveyBudget const& budget = plenty,
                   std::optional<SurveyGoal> const& goal = {}, std::span<AirPlace const> others = {},
                   double seconds = 0.0) {
  return planner.next(lot, start, budget, goal, others, after(seconds));
}

/// Every place was seen from everywhere, with nothing in it, until nothing is left to learn.
LotMap all_seen(double seconds = 0.0) {
  auto lot = lot_map();
  for (int round = 0; round < 6; ++round)
    for (double x = 5.0 + round; x < 60.0; x += 6.0)
      for (double y = 2.0 + 0.5 * round; y < 40.0; y += 5.0) lot.add(sight_at(x, y, seconds));
  return lot;
}

template <class T>
bool is(SurveyStep const& step) {
  return std::holds_alternative<T>(step);
}

SurveyEnding ending_of(SurveyStep const& step) {
  return std::get<SurveyEnd>(step).reason;
}

TEST(SurveyPlanner, FliesWhereMuchIsToBeLearnedWithinFenceAndHeights) {
  auto const step = step_of(planner_of(), lot_map());
  ASSERT_TRUE(is<SurveyGoal>(step));
  auto const& goal = std::get<SurveyGoal>(step);
  EXPECT_GT(goal.bits, 5.0);
  EXPECT_GT(goal.takes_s, 0.0);
  EXPECT_EQ(goal.place.z(), 20.0) << "the highest tells most a second as long as it sees well";
  EXPECT_GT(goal.place.x(), -3.0);
  EXPECT_LT(goal.place.x(), 63.0);
  EXPECT_GT(goal.place.y(), -3.0);
  EXPECT_LT(goal.place.y(), 43.0);
}

TEST(SurveyPlanner, FliesLowerWhereTheCameraSeesTooLittleFromAbove) {
  auto settings = standard();
  settings.camera = geo::pinhole(160, 120, 1.08);  // 8 cm a pixel at 10 m, 15 cm at 20 m
  auto const step = step_of(planner_of(settings), lot_map());
  ASSERT_TRUE(is<SurveyGoal>(step));
  EXPECT_LE(std::get<SurveyGoal>(step).place.z(), 10.0);
}

TEST(SurveyPlanner, TheSameValuesGiveTheSameStep) {
  auto const a = std::get<SurveyGoal>(step_of(planner_of(), lot_map()));
  auto const b = std::get<SurveyGoal>(step_of(planner_of(), lot_map()));
  EXPECT_EQ(a.place, b.place);
  EXPECT_EQ(a.bits, b.bits);
}

TEST(SurveyPlanner, KeepsItsGoalWhileItFliesThere) {
  auto const planner = planner_of();
  auto const goal = std::get<SurveyGoal>(step_of(planner, lot_map()));
  SurveyDrone const on_the_way = {.place = {0.5 * (5.0 + goal.place.x()), 0.5 * (5.0 + goal.place.y()), 15.0}};
  auto const next = planner.next(lot_map(), on_the_way, plenty, goal, {}, after(3.0));
  ASSERT_TRUE(is<SurveyGoal>(next));
  EXPECT_EQ(std::get<SurveyGoal>(next).place, goal.place);
}

TEST(SurveyPlanner, EndsWithTheReasonAndTheCoverage) {
  auto const planner = planner_of();
  auto const seen = all_seen();
  auto const done = step_of(planner, seen);
  ASSERT_TRUE(is<SurveyEnd>(done));
  EXPECT_EQ(ending_of(done), SurveyEnding::nothing_more);
  EXPECT_EQ(std::get<SurveyEnd>(done).coverage, seen.coverage());
  EXPECT_GT(seen.coverage(), 0.98);
  auto const lot = lot_map();
  EXPECT_EQ(ending_of(step_of(planner, lot, {.home = {5, 5}, .is_asked_to_end = true})), SurveyEnding::asked_to);
  EXPECT_EQ(ending_of(step_of(planner, lot, {.home = {5, 5}, .time_s = 0.0})), SurveyEnding::time);
  EXPECT_EQ(ending_of(step_of(planner, lot, {.home = {60, 40}, .flying_s = 5.0})), SurveyEnding::energy);
  SurveyDrone const outside = {.place = {80.0, 5.0, 10.0}};
  EXPECT_EQ(ending_of(planner.next(lot, outside, plenty, {}, {}, after(0.0))), SurveyEnding::out_of_fence);
}

TEST(SurveyPlanner, FliesNoFartherThanItsEnergyTakesItHome) {
  auto const planner = planner_of();
  for (double flying_s = 1.0; flying_s < 60.0; flying_s += 1.0) {
    SurveyBudget const budget{.home = {5, 5}, .flying_s = flying_s};
    auto const step = step_of(planner, lot_map(), budget);
    if (auto const* goal = std::get_if<SurveyGoal>(&step)) {
      EXPECT_LE(goal->takes_s + planner.seconds_home(goal->place, budget), flying_s + 1e-9);
    } else {
      EXPECT_EQ(ending_of(step), SurveyEnding::energy);
    }
  }
}

TEST(SurveyPlanner, WhoKeepsWatchingWaitsAndLooksAgainAtWhatGrewOld) {
  auto settings = standard();
  settings.keeps_watching = true;
  auto const planner = planner_of(settings);
  auto lot = all_seen();
  for (int i = 0; i < 3; ++i) {
    auto sight = sight_at(20.0 + 5.0 * i, 20.0, 0.0);
    for (int k = 0; k < 8; ++k)
      sight.slots.push_back({.outline = slot_at(15.0 + 2.5 * k, 20.0), .surety = 0.95, .taken_chance = 0.98});
    lot.add(sight);
  }
  EXPECT_TRUE(is<SurveyWait>(step_of(planner, lot)));
  auto const later = step_of(planner, lot, plenty, {}, {}, 7200.0);
  ASSERT_TRUE(is<SurveyGoal>(later)) << "two hours later cars have come and gone";
  auto const& place = std::get<SurveyGoal>(later).place;
  EXPECT_LT(std::abs(place.x() - 24.0), 14.0);
  EXPECT_LT(std::abs(place.y() - 20.0), 8.0);
  EXPECT_TRUE(is<SurveyEnd>(step_of(planner_of(), lot, plenty, {}, {}, 7200.0))) << "who does not watch has seen it";
}

TEST(SurveyPlanner, LeavesToOthersWhatTheyWillSee) {
  auto const planner = planner_of();
  auto const alone = std::get<SurveyGoal>(step_of(planner, lot_map()));
  std::vector<AirPlace> const others = {alone.place};
  auto const shared = step_of(planner, lot_map(), plenty, {}, others);
  ASSERT_TRUE(is<SurveyGoal>(shared));
  EXPECT_GT(geo::distance_m(std::get<SurveyGoal>(shared).place, alone.place), 5.0);
}

TEST(SurveyPlanner, JudgesPlacesThatOperatorsWant) {
  auto const planner = planner_of();
  auto lot = lot_map();
  EXPECT_TRUE(planner.is_in_bounds(lot, {30, 20}, after(0.0)));
  EXPECT_FALSE(planner.is_in_bounds(lot, {64.5, 20}, after(0.0))) << "outside of the area";
  auto sight = sight_at(20.0, 20.0, 0.0);
  for (int k = 0; k < 6; ++k) sight.slots.push_back({.outline = slot_at(14.0 + 2.5 * k, 20.0), .surety = 0.95});
  lot.add(sight);
  EXPECT_TRUE(planner.is_in_bounds(lot, {20, 26}, after(0.0)));
  EXPECT_FALSE(planner.is_in_bounds(lot, {55, 35}, after(0.0))) << "far from all parking that is known";
}

TEST(SurveyPlanner, ACameraThatLooksAheadIsFlownBehindWhatItSees) {
  auto settings = standard();
  settings.tilt_rad = 0.5;
  auto const step = step_of(planner_of(settings), lot_map());
  ASSERT_TRUE(is<SurveyGoal>(step));
  EXPECT_GT(std::get<SurveyGoal>(step).bits, 2.0);
}

TEST(SurveyPlanner, RefusesSettingsThatMakeNoSense) {
  geo::Polygon<geo::SiteFrame> const fence = {{{{-5, -5}, {65, -5}, {65, 45}, {-5, 45}}}};
  auto settings = standard();
  settings.lowest_m = 30.0;
  EXPECT_FALSE(SurveyPlanner::make(fence, settings));
  settings = standard();
  settings.camera.focal_x_px = 0.0;
  EXPECT_FALSE(SurveyPlanner::make(fence, settings));
  settings = standard();
  settings.tilt_rad = std::numbers::pi;  // at the sky
  auto const sky = SurveyPlanner::make(fence, settings);
  ASSERT_FALSE(sky);
  EXPECT_NE(sky.error().message.find("ground"), std::string::npos);
  settings = standard();
  settings.flight.speed_m_s = 0.0;
  EXPECT_FALSE(SurveyPlanner::make(fence, settings));
  EXPECT_FALSE(SurveyPlanner::make({{{{0, 0}, {1, 0}}}}, standard()));
}

TEST(SurveyPlanner, RowsGoAlongTheNarrowestWay) {
  EXPECT_NEAR(std::abs(std::cos(narrowest_axis(testing::rectangle(60.0, 40.0)))), 1.0, 1e-9);
  EXPECT_NEAR(std::abs(std::sin(narrowest_axis(testing::rectangle(40.0, 60.0)))), 1.0, 1e-9);
}

TEST(Flight, TimesAreThoseOfATrapezoidOrATriangle) {
  FlightLimits const limits;  // 5 m/s, 2 m/s^2
  EXPECT_DOUBLE_EQ(seconds_to_fly(0.0, limits), 0.0);
  EXPECT_DOUBLE_EQ(seconds_to_fly(8.0, limits), 4.0);
  EXPECT_DOUBLE_EQ(seconds_to_fly(50.0, limits), 12.5);
  EXPECT_DOUBLE_EQ(seconds_to_move(8.0, 20.0, 0.0, limits), 10.0);
  EXPECT_DOUBLE_EQ(seconds_to_move(8.0, 0.0, -std::numbers::pi / 2.0, limits), 4.0);
  EXPECT_DOUBLE_EQ(seconds_to_move(0.0, 0.0, 0.8, limits), 1.0);
}

}  // namespace
}  // namespace lapwing::explore
