#include "vision/lot/markings.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

constexpr double metres = 0.03;

int pixels(double length) {
  return static_cast<int>(std::lround(length / metres));
}

cv::Mat asphalt() {
  return {pixels(15.0), pixels(20.0), CV_8UC3, cv::Scalar(90, 92, 95)};
}

TEST(Markings, APaintedLineIsOneLineInItsMiddle) {
  for (auto const& paint : {cv::Scalar(230, 230, 230), cv::Scalar(60, 180, 220)}) {  // white, yellow
    auto picture = asphalt();
    cv::line(picture, {pixels(4.0), pixels(5.0)}, {pixels(9.0), pixels(5.0)}, paint, pixels(0.12));
    auto const lines = painted_lines(picture, metres);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_NEAR(lines[0].length(), 5.0, 0.3);
    EXPECT_NEAR(0.5 * (lines[0].from.x + lines[0].to.x), 6.5, 0.1);
    EXPECT_NEAR(0.5 * (lines[0].from.y + lines[0].to.y), 5.0, 0.06);
  }
}

TEST(Markings, AnEdgeOrABroadStripIsNoLine) {
  auto picture = asphalt();
  cv::rectangle(picture, cv::Rect(0, 0, pixels(20.0), pixels(6.0)), {170, 170, 170}, cv::FILLED);
  cv::rectangle(picture, cv::Rect(pixels(3.0), pixels(9.0), pixels(12.0), pixels(2.0)), {220, 220, 220}, cv::FILLED);
  EXPECT_TRUE(painted_lines(picture, metres).empty());
}

TEST(Markings, PicturesOfAlmostNothingHaveNone) {
  EXPECT_TRUE(painted_lines({}, metres).empty());
  EXPECT_TRUE(painted_lines(cv::Mat(1, 4000, CV_8UC3, cv::Scalar::all(90)), metres).empty());
  EXPECT_TRUE(painted_lines(asphalt(), metres).empty());
}

}  // namespace
}  // namespace lapwing::vision
