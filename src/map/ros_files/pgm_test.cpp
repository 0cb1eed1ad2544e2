// Grey maps as floor plans come: binary and plain, of any depth, with comments.
#include "map/ros_files/pgm.hpp"

#include <gtest/gtest.h>

namespace lapwing::map {
namespace {

using namespace std::string_view_literals;

std::vector<int> values_of(std::string_view bytes) {
  auto const picture = read_pgm(bytes);
  if (!picture) return {};
  return {picture->values.begin(), picture->values.end()};
}

TEST(Pgm, EveryKindOfGreyMapIsRead) {
  EXPECT_EQ(values_of("P5\n2 1\n255\n\x00\xfe"sv), (std::vector{0, 254}));
  EXPECT_EQ(values_of("P5 # made by hand\n# 0.05 m\n2 1 100\n\x00\x64"sv), (std::vector{0, 255}));
  EXPECT_EQ(values_of("P5\n2 1\n65535\n\x00\x00\xff\xff"sv), (std::vector{0, 255}));
  EXPECT_EQ(values_of("P2\n3 1\n255\n0 205\n254\n"sv), (std::vector{0, 205, 254}));
  EXPECT_EQ(values_of("P2 2 1 1 0 1"sv), (std::vector{0, 255}));
}

TEST(Pgm, WhatIsNoneIsRefusedWithTheReason) {
  auto const reason = [](std::string_view bytes) {
    auto const picture = read_pgm(bytes);
    return picture ? "none" : picture.error().message;
  };
  EXPECT_EQ(reason("P6 1 1 255\nabc"sv), "it does not begin with P5 or P2");
  EXPECT_EQ(reason("P5 1"sv), "its head lacks width, height or greatest value");
  EXPECT_EQ(reason("P5 0 1 255\n"sv), "its width, height or greatest value makes no picture");
  EXPECT_EQ(reason("P5 2 2 255\nabc"sv), "it ends before its last row");
  EXPECT_EQ(reason("P5 2000000000 2000000000 255\nabc"sv), "it has more than 400 million pixels");
  EXPECT_EQ(reason("P2 2 1 255 1 x"sv), "it ends before its last row, or a pixel is no number");
}

}  // namespace
}  // namespace lapwing::map
