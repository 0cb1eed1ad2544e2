#include "slam/loops/loop_search.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

constexpr double apart_m = 12.0;

/// Two rooms of 5 by 5 m with a cupboard in the corner, one like the other, on a corridor.
testing::Building two_equal_rooms() {
  testing::Building building{{{-5, -2}, {17, -2}}, {{-5, -2}, {-5, 0}}, {{17, -2}, {17, 0}}, {{-5, 0}, {-2.5, 0}}};
  for (auto const x : {0.0, apart_m}) {
    Eigen::Vector2d const at(x, 0.0);
    std::vector<Eigen::Vector2d> const corners{{-0.6, 0}, {-2.5, 0}, {-2.5, 5}, {1.0, 5}, {1.0, 4}, {2.5, 4}, {2.5, 0}};
    for (std::size_t k = 1; k < corners.size(); ++k) building.push_back({at + corners[k - 1], at + corners[k]});
    building.push_back({at + corners.back(), at + Eigen::Vector2d(0.6, 0)});
  }
  building.push_back({{2.5, 0}, {apart_m - 2.5, 0}});
  building.push_back({{apart_m + 2.5, 0}, {17, 0}});
  return building;
}

/// What a robot sees that drives into them along a way.
Graph along(std::vector<Eigen::Vector2d> const& way) {
  auto const drive = testing::drive(two_equal_rooms(), way, {});
  Graph graph;
  double path_m = 0.0;
  for (std::size_t i = 0; i < drive.truth.size(); ++i) {
    auto const& truth = drive.truth[i];
    if (!graph.poses.empty()) {
      auto const step = distance_m(drive.truth[static_cast<std::size_t>(graph.frames.back().scan)], truth);
      if (step < 0.2) continue;
      path_m += step;
    }
    graph.frames.push_back({.scan = static_cast<int>(i),
                            .frame = frame_of(drive.log.scans[i], drive.log.sensors[0], {}),
                            .path_m = path_m});
    graph.poses.push_back(truth);
    auto const k = graph.size() - 1;
    if (k > 0)
      graph.constraints.push_back({.from = k - 1, .to = k, .from_to = between(graph.poses[k - 1], graph.poses[k])});
  }
  return graph;
}

/// Into both and into the first one again, which odometry puts half-way between the two.
Graph into_two_rooms_and_the_first_again() {
  auto graph = along({{-4, -1}, {0, -1}, {0, 3}, {0, -1}, {12, -1}, {12, 3}, {12, -1}, {-4, -1}, {0, -1}, {0, 3}});
  auto const last_m = graph.frames.back().path_m;
  for (int k = 0; k < graph.size(); ++k)
    if (last_m - graph.frames[k].path_m < 4.0) graph.poses[k].x += 0.5 * apart_m;
  return graph;
}

std::vector<Closure> claims_of_the_last(Graph const& whole, DriftRates const& rates,
                                        double most_deviations = LoopOptions().most_deviations) {
  LoopOptions options;
  options.rates = rates;
  LoopSearch search(options, one_by_one);
  Graph graph;
  for (int k = 0; k < whole.size(); ++k) {
    graph.frames.push_back(whole.frames[k]);
    graph.poses.push_back(whole.poses[k]);
    search.follow(graph);
  }
  return search.look(whole, whole.size() - 1, {.most_deviations = most_deviations, .most_places = 4});
}

TEST(LoopSearch, CallsAClaimAmbiguousThatFitsAsWellAtAnotherPlace) {
  auto const graph = into_two_rooms_and_the_first_again();
  auto const claims = claims_of_the_last(graph, {.shift_per_sqrt_m = 0.4});
  auto const claimed_x = [&](Closure const& claim) { return (graph.poses[claim.target] * claim.target_to_query).x; };
  auto const is_at = [&](double x) {
    return std::ranges::any_of(claims, [&](Closure const& c) { return std::abs(claimed_x(c) - x) < 0.5; });
  };
  EXPECT_TRUE(is_at(0.0));
  EXPECT_TRUE(is_at(apart_m));
  for (auto const& claim : claims) EXPECT_GT(claim.rival, LoopOptions{}.ambiguous_rival * claim.score);
}

TEST(LoopSearch, DropsWhatTheWayBetweenDoesNotLetExpect) {
  // Into the first room, and into the second one for the first time, which is like it. Turns that err move what is far
  // to one side: as far as the first room, but across the corridor and not along it.
  auto const graph = along({{-4, -1}, {0, -1}, {0, 3}, {0, -1}, {12, -1}, {12, 3}});
  for (auto const& claim : claims_of_the_last(graph, {.turn_per_sqrt_m = 0.25}))
    ADD_FAILURE() << claim.target << ", " << claim.deviations << " standard deviations";
  auto const hardly = claims_of_the_last(graph, {.shift_per_sqrt_m = 1.0}, 3.5);
  ASSERT_FALSE(hardly.empty()) << "where odometry may err so far";
  for (auto const& claim : hardly) EXPECT_FALSE(claim.is_expected) << claim.deviations;
  for (auto const& claim : claims_of_the_last(graph, {.shift_per_sqrt_m = 2.0})) EXPECT_TRUE(claim.is_expected);
}

}  // namespace
}  // namespace lapwing::slam
