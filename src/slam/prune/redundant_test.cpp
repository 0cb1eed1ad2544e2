#include "slam/prune/let_go.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

constexpr int steps = 40;  // of a pass

/// Passes along a corridor, always the same way, a key frame each 0.25 m and all of them joined.
Graph passes(int count) {
  Graph graph;
  for (int pass = 0; pass < count; ++pass) {
    for (int i = 0; i < steps; ++i) {
      auto const k = graph.size();
      graph.frames.push_back({.scan = 3 * k, .frame = {}, .path_m = 0.25 * k});
      graph.poses.push_back({0.25 * i, 0.02 * pass, 0.0});
      if (k == 0) continue;
      auto const from_to = between(graph.poses[k - 1], graph.poses[k]);
      graph.constraints.push_back(
          {.from = k - 1, .to = k, .from_to = from_to, .information = 100.0 * Eigen::Matrix3d::Identity()});
    }
  }
  return graph;
}

PruneOptions options() {
  return {.passes = 3, .fresh_frames = steps / 2};
}

TEST(RedundantFrames, AreNoneWhereAPlaceWasPassedAFewTimes) {
  EXPECT_TRUE(redundant_frames(passes(3), options()).empty());
}

TEST(RedundantFrames, AreThoseOfTheOldestPasses) {
  auto const redundant = redundant_frames(passes(5), options());
  // Of five passes three are newer than each of the first two; the first key frame holds the frame.
  ASSERT_EQ(redundant.size(), 2U * steps - 1U);
  EXPECT_EQ(redundant.front().frame, 1);
  EXPECT_EQ(redundant.back().frame, 2 * steps - 1);
  for (auto const& one : redundant) EXPECT_EQ(one.heir / steps, 3) << "the one in the middle of the three that stay";
}

TEST(RedundantFrames, AreNoneOfThoseThatLookElsewhere) {
  auto graph = passes(5);
  for (int k = 0; k < steps; ++k) graph.poses[k].yaw = 3.0;
  auto const redundant = redundant_frames(graph, options());
  EXPECT_TRUE(std::ranges::none_of(redundant, [](Redundant const& one) { return one.frame < steps; }));
}

TEST(LetGo, LeavesOneGraphWithTheKeyFramesThatStay) {
  auto graph = passes(5);
  auto const before = graph;
  auto const redundant = redundant_frames(graph, options());
  auto const renumbering = let_go(graph, redundant, 6);
  ASSERT_EQ(graph.size(), before.size() - static_cast<int>(redundant.size()));
  for (int k = 0; k < before.size(); ++k) {
    auto const& [heir, in_heir] = renumbering.inheritances[k];
    EXPECT_LT(distance_m(graph.poses[heir] * in_heir, before.poses[k]), 1e-9);
    if (!renumbering.stays(k)) continue;
    EXPECT_EQ(graph.frames[renumbering.now[k]].scan, before.frames[k].scan);
  }
  // The steps are still one chain.
  ASSERT_EQ(graph.constraints.size(), graph.frames.size() - 1);
  for (int k = 1; k < graph.size(); ++k)
    EXPECT_TRUE(
        std::ranges::any_of(graph.constraints, [k](Constraint const& c) { return std::max(c.from, c.to) == k; }));
}

TEST(LetGo, MarksWhereOneKeyFrameDoesNotFollowOnTheLastAnyMore) {
  auto graph = passes(5);
  (void)let_go(graph, redundant_frames(graph, options()), 6);
  // The first key frame stays, and what followed on it is gone; the third pass begins at its place.
  EXPECT_FALSE(graph.frames[1].is_cut);
  EXPECT_TRUE(std::ranges::none_of(graph.frames, &KeyFrame::is_cut));
  auto halves = passes(5);
  for (int k = steps / 2; k < steps; ++k) halves.poses[k].y += 5.0;  // a detour, once
  (void)let_go(halves, redundant_frames(halves, options()), 6);
  EXPECT_EQ(std::ranges::count_if(halves.frames, &KeyFrame::is_cut), 2);
}

}  // namespace
}  // namespace lapwing::slam
