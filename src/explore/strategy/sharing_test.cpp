// Places shared out among robots: near ones to who is near, nothing twice, and what nobody reaches to nobody.
#include "explore/strategy/sharing.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lapwing::explore {
namespace {

/// Places on a line, and a robot at `at_m`.
TourCosts costs_on_a_line(std::vector<double> const& places, double at_m) {
  TourCosts costs;
  for (double const a : places) {
    costs.from_start.push_back(std::abs(a - at_m));
    costs.between.emplace_back();
    for (double const b : places) costs.between.back().push_back(std::abs(a - b));
  }
  costs.end.assign(places.size(), 0.0);
  return costs;
}

TEST(SharedOut, EachRobotGetsWhatIsNearIt) {
  std::vector<double> const places = {0.0, 1.0, 9.0, 10.0};
  std::vector const robots = {costs_on_a_line(places, 9.5), costs_on_a_line(places, 0.5)};
  auto given = shared_out(robots, {0, 1, 2, 3});
  for (auto& mine : given) std::ranges::sort(mine);
  EXPECT_EQ(given[0], (std::vector<std::size_t>{2, 3}));
  EXPECT_EQ(given[1], (std::vector<std::size_t>{0, 1}));
}

TEST(SharedOut, OneGetsAll) {
  std::vector<double> const places = {5.0, 1.0, 9.0};
  std::vector const robots = {costs_on_a_line(places, 0.0)};
  auto given = shared_out(robots, {2, 0, 1});
  std::ranges::sort(given[0]);
  EXPECT_EQ(given[0], (std::vector<std::size_t>{0, 1, 2}));
}

TEST(SharedOut, WhatNobodyReachesGoesToNobody) {
  std::vector<double> const places = {1.0, 2.0};
  auto costs = costs_on_a_line(places, 0.0);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  costs.from_start[1] = costs.between[0][1] = costs.between[1][0] = infinity;
  std::vector const robots = {costs};
  EXPECT_EQ(shared_out(robots, {0, 1})[0], std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace lapwing::explore
