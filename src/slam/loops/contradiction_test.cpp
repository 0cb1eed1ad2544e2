#include "slam/loops/contradiction.hpp"

#include <gtest/gtest.h>

#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

/// A robot that drives along a corridor with offices and back; a key frame every half metre where it truly is.
Graph there_and_back() {
  auto const building = testing::office(24.0, 12.0, 4.0, 1.0, 5);
  auto const drive =
      testing::drive(building, {{0, 0}, {20, 0}, {0, 0}}, {.beams = 361, .field_of_view_rad = 6.2831853});
  Graph graph;
  double path_m = 0.0;
  for (std::size_t i = 0; i < drive.truth.size(); ++i) {
    if (!graph.poses.empty() && distance_m(graph.poses.back(), drive.truth[i]) < 0.5) continue;
    if (!graph.poses.empty()) path_m += distance_m(graph.poses.back(), drive.truth[i]);
    graph.frames.push_back({.scan = static_cast<int>(i),
                            .frame = frame_of(drive.log.scans[i], drive.log.sensors[0], {}),
                            .path_m = path_m});
    graph.poses.push_back(drive.truth[i]);
  }
  return graph;
}

/// As if the way back had been joined to the way there in the wrong place.
std::vector<Pose2> with_way_back_shifted(Graph const& graph, double shift_m) {
  auto poses = graph.poses;
  for (std::size_t k = poses.size() / 2; k < poses.size(); ++k) poses[k].x += shift_m;
  return poses;
}

TEST(Contradiction, IsGreatWhereAFalseLoopLaysOfficesUponWalls) {
  auto const graph = there_and_back();
  auto const shifted = with_way_back_shifted(graph, 2.0);
  auto const truth = agreement_of_passes(graph, graph.poses, shifted, 5.0, one_by_one);
  auto const falsely = agreement_of_passes(graph, shifted, graph.poses, 5.0, one_by_one);
  ASSERT_GT(truth.seen(), 1000);
  ASSERT_GT(falsely.seen(), 1000);
  EXPECT_LT(truth.conflict(), 0.03);
  EXPECT_GT(falsely.conflict(), truth.conflict() + 0.03);
}

TEST(Contradiction, LooksOnlyAtWhatHasComeToLieOtherwise) {
  auto const graph = there_and_back();
  EXPECT_EQ(agreement_of_passes(graph, graph.poses, graph.poses, 5.0, one_by_one).seen(), 0);
}

}  // namespace
}  // namespace lapwing::slam
