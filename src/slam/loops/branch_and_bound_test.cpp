#include "slam/loops/branch_and_bound.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

using Points = std::vector<Eigen::Vector2f>;

void line(Points& points, Eigen::Vector2f const& from, Eigen::Vector2f const& to) {
  auto const count = static_cast<int>((to - from).norm() / 0.05F);
  for (int i = 0; i <= count; ++i)
    points.emplace_back(from + (to - from) * (static_cast<float>(i) / static_cast<float>(count)));
}

/// A room with one corner cut off, so that it looks different from every side.
Points room() {
  Points points;
  line(points, {0, 0}, {7, 0});
  line(points, {7, 0}, {7, 3});
  line(points, {7, 3}, {5, 5});
  line(points, {5, 5}, {0, 5});
  line(points, {0, 5}, {0, 0});
  return points;
}

Points seen_from(Points const& points, Pose2 const& pose) {
  Points seen;
  for (auto const& p : points) {
    Eigen::Vector2d const v = Turn(pose.yaw).back(p.cast<double>() - place(pose));
    seen.push_back(v.cast<float>());
  }
  return seen;
}

TEST(BranchAndBound, FindsWhereThePointsLieAndSaysThatNothingElseLooksLikeIt) {
  Pose2 const truth{2.0, 1.5, 0.5};
  auto const match = branch_and_bound(Pyramid(room()), seen_from(room(), truth), {{1.2, 2.4, 0.3}, 2.0, 0.4}, 0.6);
  ASSERT_TRUE(match);
  EXPECT_LT(distance_m(match->pose, truth), 0.12);
  EXPECT_LT(turn_rad(match->pose, truth), 0.02);
  EXPECT_GT(match->score, 0.8);
  EXPECT_LT(match->rival, 0.85 * match->score);
}

/// What is looked for, and in which window.
struct Search {
  Pose2 truth;
  LoopWindow window;
};
class EveryPose : public ::testing::TestWithParam<Search> {};

TEST_P(EveryPose, IsNoBetterThanTheOneFound) {
  Pyramid const pyramid(room());
  auto const& window = GetParam().window;
  auto const query = seen_from(room(), GetParam().truth);
  auto const match = branch_and_bound(pyramid, query, window, 0.3);
  ASSERT_TRUE(match);
  double best = 0.0;
  constexpr double degree = 3.14159265358979 / 180.0;
  auto const turns = static_cast<int>(std::ceil(window.reach_rad / degree));
  auto const shifts = static_cast<int>(std::ceil(window.reach_m / Pyramid::cell_m));
  for (int a = -turns; a <= turns; ++a) {
    auto const yaw = window.guess.yaw + a * degree;
    auto const cosine = static_cast<float>(std::cos(yaw));
    auto const sine = static_cast<float>(std::sin(yaw));
    std::vector<Eigen::Vector2i> cells;
    for (auto const& p : query) {
      Eigen::Vector2f const at =
          (place(window.guess).cast<float>() +
           Eigen::Vector2f(cosine * p.x() - sine * p.y(), sine * p.x() + cosine * p.y()) - pyramid.origin()) /
          Pyramid::cell_m;
      cells.emplace_back(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())));
    }
    for (int x = -shifts; x <= shifts; ++x) {
      for (int y = -shifts; y <= shifts; ++y) {
        int sum = 0;
        for (auto const& cell : cells) sum += pyramid.at(0, cell.x() + x, cell.y() + y);
        best = std::max(best, sum / (255.0 * static_cast<double>(query.size())));
      }
    }
  }
  EXPECT_NEAR(match->score, best, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(BranchAndBound, EveryPose,
                         ::testing::Values(Search{{2.03, 1.47, 0.31}, {{2.4, 1.2, 0.25}, 0.8, 0.12}},
                                           // Most of the window lies beyond the map, and there are several shifts to
                                           // each side on the coarsest level.
                                           Search{{2.03, 1.47, 0.31}, {{-3.0, 5.5, 0.3}, 6.0, 0.05}}));

TEST(BranchAndBound, ACorridorHasARival) {
  Points corridor;
  line(corridor, {0, 0}, {20, 0});
  line(corridor, {0, 2}, {20, 2});
  Points part;
  line(part, {0, 0}, {6, 0});
  line(part, {0, 2}, {6, 2});
  auto const match = branch_and_bound(Pyramid(corridor), part, {{7.0, 0.0, 0.0}, 3.0, 0.1}, 0.6);
  ASSERT_TRUE(match);
  EXPECT_GT(match->rival, 0.95 * match->score);
}

TEST(BranchAndBound, FindsNothingWhereNothingIsAlike) {
  Points far{{50.0F, 50.0F}, {51.0F, 50.0F}};
  EXPECT_FALSE(branch_and_bound(Pyramid(room()), far, {{0.0, 0.0, 0.0}, 1.0, 0.1}, 0.5));
  EXPECT_FALSE(branch_and_bound(Pyramid(room()), {}, {{0.0, 0.0, 0.0}, 1.0, 0.1}, 0.5));
}

}  // namespace
}  // namespace lapwing::slam
