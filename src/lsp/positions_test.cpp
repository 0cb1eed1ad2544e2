#include "lsp/positions.hpp"

#include <gtest/gtest.h>

namespace lapwing::lsp {
namespace {

/// Two lines; ä takes 2 bytes and 1 unit, the bird 4 bytes and 2 units.
base::SourceFile sample() {
  return {"test", "aä🐦b\r\nxyz"};
}

TEST(Positions, CountUtf16UnitsFromLineAndCharacterZero) {
  auto const source = sample();
  Positions positions(source);
  EXPECT_EQ(positions.of(0), (Position{0, 0}));
  EXPECT_EQ(positions.of(1), (Position{0, 1}));
  EXPECT_EQ(positions.of(3), (Position{0, 2}));
  EXPECT_EQ(positions.of(7), (Position{0, 4}));
  EXPECT_EQ(positions.of(8), (Position{0, 5}));
  EXPECT_EQ(positions.of(10), (Position{1, 0}));
  EXPECT_EQ(positions.of(99), (Position{1, 3}));
  EXPECT_EQ(positions.of(1), (Position{0, 1})) << "backwards too";
}

TEST(Positions, FindTheOffsetAgain) {
  auto const source = sample();
  Positions positions(source);
  for (std::uint32_t const offset : {0u, 1u, 3u, 7u, 8u, 10u, 12u, 13u}) {
    EXPECT_EQ(positions.offset(positions.of(offset)), offset);
  }
}

TEST(Positions, StayInsideTheTextAndInsideCharacters) {
  auto const source = sample();
  Positions const positions(source);
  EXPECT_EQ(positions.offset({0, 99}), 8u) << "the end of the line";
  EXPECT_EQ(positions.offset({99, 0}), 13u) << "the end of the text";
  EXPECT_EQ(positions.offset({0, 3}), 7u) << "the middle of the bird counts as its end";
}

TEST(Positions, OfAnEmptyText) {
  base::SourceFile const source("test", "");
  Positions positions(source);
  EXPECT_EQ(positions.of(0), (Position{0, 0}));
  EXPECT_EQ(positions.offset({0, 0}), 0u);
  EXPECT_EQ(positions.offset({5, 5}), 0u);
}

}  // namespace
}  // namespace lapwing::lsp
