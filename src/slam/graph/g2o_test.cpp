#include "slam/graph/g2o.hpp"

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

TEST(G2o, ReadsWhatItWrites) {
  std::vector<Pose2> const poses{{0.0, 0.0, 0.0}, {1.0, 0.25, -0.5}, {2.0, 0.5, 3.0}};
  Constraint edge{.from = 0, .to = 2, .from_to = {1.5, 2.5, 0.125}, .is_loop = true};
  edge.information << 4.0, 0.5, 0.25, 0.5, 5.0, 0.75, 0.25, 0.75, 6.0;
  auto const graph = read_g2o(write_g2o(poses, {edge}));
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_EQ(graph->poses, poses);
  ASSERT_EQ(graph->constraints.size(), 1U);
  EXPECT_EQ(graph->constraints[0].from_to, edge.from_to);
  EXPECT_EQ(graph->constraints[0].information, edge.information);
  EXPECT_TRUE(graph->constraints[0].is_loop);
}

TEST(G2o, CountsPosesWhoseNumbersHaveGaps) {
  auto const graph = read_g2o("VERTEX_SE2 100 1 0 0\nVERTEX_SE2 7 0 0 0\nFIX 7\nEDGE_SE2 7 100 1 0 0 1 0 0 1 0 1\n");
  ASSERT_TRUE(graph) << graph.error().message;
  EXPECT_EQ(graph->poses[1].x, 1.0);
  EXPECT_EQ(graph->constraints[0].to, 1);
}

TEST(G2o, SaysInWhichLineWhatIsWrong) {
  auto const message = [](std::string_view text) { return read_g2o(text).error().message; };
  EXPECT_EQ(message("VERTEX_SE2 0 1 2\n"), "line 1: expected 4 numbers");
  EXPECT_EQ(message("VERTEX_SE2 0 0 0 0\nVERTEX_SE3:QUAT 1 0\n"),
            "line 2: 'VERTEX_SE3:QUAT' is no pose or edge of the plane");
  EXPECT_EQ(message("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 5 1 0 0 1 0 0 1 0 1\n"), "line 2: there is no pose 5");
  EXPECT_EQ(message("VERTEX_SE2 0 0 0 0\nEDGE_SE2 0 0 1 0 0 1 0 0 1 0 1\n"), "line 2: an edge from a pose to itself");
  EXPECT_EQ(message("VERTEX_SE2 -1 0 0 0\n"), "line 1: a pose's number must be whole and not negative");
  EXPECT_EQ(message("VERTEX_SE2 0 nan 0 0\n"), "line 1: expected 4 numbers");
  EXPECT_EQ(message(""), "no VERTEX_SE2 or EDGE_SE2");
}

TEST(G2o, TakesThePosesOfItsEdgesWhereItNamesNone) {
  auto const graph = read_g2o("EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 2 0 0 1 0 0 1 0 1\n");
  ASSERT_TRUE(graph) << graph.error().message;
  ASSERT_EQ(graph->poses.size(), 3U);
  EXPECT_EQ(graph->poses[2], (Pose2{3.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace lapwing::slam
