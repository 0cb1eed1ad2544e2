#include "slam/loops/strided_level.hpp"

#include <random>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

constexpr int level_width = 75;
constexpr int level_height = 43;

/// Something else in each cell that is inside or begins just outside; 0 elsewhere.
std::uint8_t cell_value(int x, int y) {
  auto const is_out = x <= -StridedLevel::stride || y <= -StridedLevel::stride || x >= level_width || y >= level_height;
  return is_out ? std::uint8_t{0} : static_cast<std::uint8_t>(1 + (x * 31 + y * 57 + 100'000) % 255);
}

/// The sums over these points at each shift, one after the other.
void expect_sums(ShiftSums const& sums, std::vector<std::pair<int, int>> const& points) {
  for (int row = 0; row < sums.side(); ++row) {
    for (int column = 0; column < sums.side(); ++column) {
      int sum = 0;
      for (auto const& [x, y] : points)
        sum += cell_value(x + column * StridedLevel::stride, y + row * StridedLevel::stride);
      ASSERT_EQ(sums.at(column, row), sum) << "column " << column << ", row " << row;
    }
  }
}

TEST(StridedLevel, SumsWhatPointsHaveAtEachShiftWhereverTheyLie) {
  StridedLevel const level(level_width, level_height, cell_value);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> anywhere(-400, 200);
  for (auto const side : {1, 2, 15, 16, 17, 40}) {
    ShiftSums sums(side);
    std::vector<std::pair<int, int>> points;
    // More of them than fit into 16 bits.
    for (int k = 0; k < 700; ++k) {
      points.emplace_back(anywhere(random), anywhere(random));
      level.add(points.back().first, points.back().second, sums);
    }
    expect_sums(sums, points);
  }
}

TEST(StridedLevel, ManyPointsOnOneCellDoNotRunOver) {
  StridedLevel const level(level_width, level_height, [](int, int) { return std::uint8_t{255}; });
  ShiftSums sums(3);
  for (int k = 0; k < 1'000; ++k) level.add(0, 0, sums);
  EXPECT_EQ(sums.at(0, 0), 255'000);
  EXPECT_EQ(sums.at(2, 2), 255'000);
}

TEST(StridedLevel, ClearedSumsBeginAnew) {
  StridedLevel const level(level_width, level_height, cell_value);
  ShiftSums sums(4);
  for (int k = 0; k < 300; ++k) level.add(3, 5, sums);
  sums.clear();
  level.add(-20, 7, sums);
  expect_sums(sums, {{-20, 7}});
}

}  // namespace
}  // namespace lapwing::slam
