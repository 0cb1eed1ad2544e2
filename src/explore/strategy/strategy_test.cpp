// What strategies decide with: the table of the right-hand rule, and tours beside the best ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "explore/strategy/open_tour.hpp"
#include "explore/strategy/right_hand.hpp"

namespace lapwing::explore {
namespace {

TEST(RightHand, TurnsAsTheEightCasesOfTheSeedSay) {
  struct Row {
    bool right, front, left;
    int quarters;
    bool pushes_left, pushes_ahead;
  };
  constexpr Row rows[] = {
      {true, false, true, 0, false, false},  {true, false, false, 0, true, false},
      {true, true, true, 1, false, false},   {true, true, false, 1, false, false},
      {false, true, false, -1, true, false}, {false, true, true, -1, false, false},
      {false, false, false, -1, true, true}, {false, false, true, -1, false, true},
  };
  for (auto const& row : rows) {
    auto const turn = RightHand::turn_for(row.right, row.front, row.left);
    EXPECT_EQ(turn.quarters, row.quarters);
    EXPECT_EQ(turn.pushes_left, row.pushes_left);
    EXPECT_EQ(turn.pushes_ahead, row.pushes_ahead);
  }
}

TEST(RightHand, KeepsItsDistanceWhereThereIsRoomAndTheMiddleElsewhere) {
  RightHand const strategy;
  double const shift = RightHandSettings().shift_rad;
  EXPECT_EQ(strategy.shift_for({.left_m = 4.0, .front_m = 5.0, .right_m = 0.8}), shift);
  EXPECT_EQ(strategy.shift_for({.left_m = 2.0, .front_m = 5.0, .right_m = 1.2}), shift) << "for pictures";
  EXPECT_EQ(strategy.shift_for({.left_m = 0.7, .front_m = 5.0, .right_m = 3.0}), -shift);
  EXPECT_EQ(strategy.shift_for({.left_m = 1.4, .front_m = 5.0, .right_m = 1.4}), 0.0);
  EXPECT_EQ(strategy.shift_for({.left_m = 0.6, .front_m = 5.0, .right_m = 0.65}), 0.0) << "the middle of a narrow one";
  EXPECT_EQ(strategy.shift_for({.left_m = 0.4, .front_m = 5.0, .right_m = 0.8}), -shift);
}

TourCosts random_costs(std::mt19937& random, std::size_t count) {
  std::uniform_real_distribution<double> side(0.0, 20.0);
  std::vector<std::pair<double, double>> places(count + 1);
  for (auto& place : places) place = {side(random), side(random)};
  auto const between = [&](std::size_t a, std::size_t b) {
    return std::hypot(places[a].first - places[b].first, places[a].second - places[b].second);
  };
  TourCosts costs;
  for (std::size_t i = 0; i < count; ++i) {
    costs.from_start.push_back(between(count, i));
    costs.between.emplace_back();
    for (std::size_t j = 0; j < count; ++j) costs.between[i].push_back(between(i, j));
    costs.end.push_back(-side(random) / 3.0);
  }
  return costs;
}

TEST(OpenTour, IsNearTheBestOne) {
  std::mt19937 random(5);
  std::vector<std::size_t> places(7);
  std::iota(places.begin(), places.end(), std::size_t{0});
  double sum_ours = 0.0;
  double sum_best = 0.0;
  for (int round = 0; round < 50; ++round) {
    auto const costs = random_costs(random, places.size());
    auto ours = good_tour(costs, places);
    double best = cost_of(costs, places);
    for (auto order = places; std::ranges::next_permutation(order).found;) best = std::min(best, cost_of(costs, order));
    double const cost = cost_of(costs, ours);
    EXPECT_GE(cost, best - 1e-9);
    sum_ours += cost;
    sum_best += best;
    std::ranges::sort(ours);
    EXPECT_EQ(ours, places);
  }
  EXPECT_LT(sum_ours, 1.03 * sum_best);
}

TEST(OpenTour, KeepsTheFirstThatIsGiven) {
  std::mt19937 random(6);
  std::vector<std::size_t> const places = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  auto const costs = random_costs(random, places.size());
  for (auto const first : places) {
    auto const tour = good_tour_from(costs, places, first);
    EXPECT_EQ(tour.front(), first);
    EXPECT_EQ(tour.size(), places.size());
  }
}

}  // namespace
}  // namespace lapwing::explore
