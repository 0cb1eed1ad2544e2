#include "slam/walls/wall_lines.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

using GridPoint = geo::Point<map::GridFrame>;

/// A grid in which surfaces are drawn as a laser leaves them: the cells that they cross, in free ground.
struct WallLinesTest : ::testing::Test {
  map::OccupancyGrid grid{0.05};

  void take(double x, double y) {
    auto const cell = grid.cell_at(GridPoint(x, y));
    constexpr int around = 3;
    for (int down = -around; down <= around; ++down)
      for (int right = -around; right <= around; ++right) set_free({cell.x + right, cell.y + down});
    grid.set(cell, map::Evidence::of_probability(0.95));
  }
  void set_free(map::Cell cell) {
    if (!grid.at(cell).is_seen()) grid.set(cell, map::Evidence::of_probability(0.1));
  }
  void draw(GridPoint const& from, GridPoint const& to) {
    auto const way = to - from;
    int const steps = static_cast<int>(way.length() / 0.01);
    for (int i = 0; i <= steps; ++i) {
      auto const at = from + way * (static_cast<double>(i) / steps);
      take(at.x(), at.y());
    }
  }
  /// The distance of the places that both ends of a surface and its middle are at from the nearest line.
  [[nodiscard]] static double off(std::vector<WallLine> const& lines, GridPoint const& from, GridPoint const& to) {
    double most = 0.0;
    for (double const share : {0.02, 0.5, 0.98}) {
      auto const place = from + (to - from) * share;
      double least = 1e9;
      for (auto const& line : lines) {
        auto const along = line.to - line.from;
        double const at = std::clamp((place - line.from).dot(along) / along.dot(along), 0.0, 1.0);
        least = std::min(least, geo::distance_m(place, line.from + along * at));
      }
      most = std::max(most, least);
    }
    return most;
  }
};

TEST_F(WallLinesTest, AreTheSidesOfARoomHoweverItLies) {
  for (double const yaw : {0.0, 0.3, 0.7, 1.2, 2.0}) {
    grid = map::OccupancyGrid(0.05);
    auto const at = [&](double x, double y) {
      return GridPoint(x * std::cos(yaw) - y * std::sin(yaw), x * std::sin(yaw) + y * std::cos(yaw));
    };
    std::vector<GridPoint> const corners = {at(0, 0), at(8, 0), at(8, 5), at(0, 5)};
    for (std::size_t i = 0; i < 4; ++i) draw(corners[i], corners[(i + 1) % 4]);
    auto const lines = find_walls(grid);
    ASSERT_EQ(lines.size(), 4U) << yaw;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(off(lines, corners[i], corners[(i + 1) % 4]), 0.06) << yaw;
    EXPECT_NEAR(lines.front().length_m(), 8.0, 0.2) << yaw;
    EXPECT_NEAR(lines.back().length_m(), 5.0, 0.2) << yaw;
    EXPECT_LT(lines.front().spread_m, 0.03) << yaw;
  }
}

TEST_F(WallLinesTest, EndAtADoorAndGoOnOverAGapBetweenBeams) {
  draw(GridPoint(0, 1), GridPoint(3, 1));
  draw(GridPoint(3.15, 1), GridPoint(5, 1));
  draw(GridPoint(5.9, 1), GridPoint(8, 1));
  auto const lines = find_walls(grid);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NEAR(lines[0].length_m(), 5.0, 0.15);
  EXPECT_NEAR(lines[1].from.x(), 5.9, 0.1);
}

TEST_F(WallLinesTest, AreTwoWhereAWallWasSeenFromBothSides) {
  draw(GridPoint(0, 1.02), GridPoint(4, 1.02));
  draw(GridPoint(0, 1.27), GridPoint(4, 1.27));
  EXPECT_EQ(find_walls(grid).size(), 2U);
}

TEST_F(WallLinesTest, AreTheTwoFacesOfAThinWallThatRangesBlurIntoOneBand) {
  for (double const yaw : {0.0, 0.5, 1.5707963}) {
    grid = map::OccupancyGrid(0.05);
    auto const at = [&](double x, double y) {
      return GridPoint(x * std::cos(yaw) - y * std::sin(yaw), x * std::sin(yaw) + y * std::cos(yaw));
    };
    for (double const y : {0.93, 0.97, 1.02, 1.07, 1.1}) draw(at(0, y), at(5, y));
    for (double x = -0.5; x < 5.5; x += 0.02)
      for (double y = 0.4; y < 1.7; y += 0.02) set_free(grid.cell_at(at(x, y)));
    auto const lines = find_walls(grid);
    ASSERT_GE(lines.size(), 2U) << yaw;
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(lines[i].length_m(), 5.0, 0.3) << yaw;
    EXPECT_LT(off(lines, at(0, 0.96), at(5, 0.96)), 0.06) << yaw;
    EXPECT_LT(off(lines, at(0, 1.08), at(5, 1.08)), 0.06) << yaw;
    for (std::size_t i = 2; i < lines.size(); ++i) EXPECT_LT(lines[i].length_m(), 0.5) << "across the wall, " << yaw;
  }
}

TEST_F(WallLinesTest, AreNoneWhereFarBeamsEndedBehindAFace) {
  for (double x = 0.0; x < 5.0; x += 0.02) {
    grid.set(grid.cell_at(GridPoint(x, 1.02)), map::Evidence::of_probability(0.95));
    grid.set(grid.cell_at(GridPoint(x, 1.22)), map::Evidence::of_probability(0.8));
    for (double y = 0.0; y < 1.0; y += 0.05) set_free(grid.cell_at(GridPoint(x, y)));
  }
  auto const lines = find_walls(grid);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines.front().from.y(), 1.025, 0.01);
}

TEST_F(WallLinesTest, AreNotMadeOfClutter) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> side(0.0, 6.0);
  for (int i = 0; i < 250; ++i) take(side(random), side(random));
  for (auto const& line : find_walls(grid)) EXPECT_LT(line.length_m(), 0.7);
  EXPECT_LE(find_walls(grid).size(), 4U);
}

TEST_F(WallLinesTest, AreNoneWhereNothingWasSeen) {
  EXPECT_TRUE(find_walls(grid).empty());
}

TEST_F(WallLinesTest, HoldOnRaggedSurfaces) {
  std::mt19937 random(9);
  std::normal_distribution<double> noise(0.0, 0.03);
  for (double along = 0.0; along < 6.0; along += 0.02) {
    take(along * std::cos(0.4) - noise(random) * std::sin(0.4), along * std::sin(0.4) + noise(random) * std::cos(0.4));
  }
  auto const lines = find_walls(grid);
  ASSERT_FALSE(lines.empty());
  EXPECT_GT(lines.front().length_m(), 4.5);
  EXPECT_LT(off({lines.front()}, GridPoint(lines.front().from), GridPoint(lines.front().to)), 1e-9);
  auto const way = lines.front().to - lines.front().from;
  EXPECT_NEAR(std::atan2(way.y(), way.x()), 0.4, 0.02);
}

}  // namespace
}  // namespace lapwing::slam
