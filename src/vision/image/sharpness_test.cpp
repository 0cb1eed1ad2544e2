#include "vision/image/sharpness.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

/// A plate with letters 60 pixels high, out of focus by `sigma` pixels, in the light `gain`.
cv::Mat plate(double sigma, double gain = 1.0) {
  cv::Mat sign(200, 500, CV_8UC3, cv::Scalar(235, 235, 235) * gain);
  cv::putText(sign, "ITB-221", {30, 130}, cv::FONT_HERSHEY_SIMPLEX, 2.6, cv::Scalar(30, 30, 30) * gain, 8, cv::LINE_AA);
  if (sigma > 0.0) cv::GaussianBlur(sign, sign, {}, sigma);
  return sign;
}

TEST(Sharpness, FallsWithBlur) {
  auto before = sharpness(plate(0.0));
  for (double const sigma : {1.0, 2.0, 3.0}) {
    auto const now = sharpness(plate(sigma));
    EXPECT_LT(now.laplacian_variance, before.laplacian_variance) << sigma;
    EXPECT_LT(now.fine_share, before.fine_share) << sigma;
    before = now;
  }
}

TEST(Sharpness, LettersThatCanBeReadAreSharp) {
  EXPECT_TRUE(is_sharp(sharpness(plate(0.0))));
  EXPECT_TRUE(is_sharp(sharpness(plate(1.5))));
  EXPECT_FALSE(is_sharp(sharpness(plate(8.0))));
}

TEST(Sharpness, TheLightMakesNoDifference) {
  auto const bright = sharpness(plate(1.0));
  auto const dark = sharpness(plate(1.0, 0.4));
  EXPECT_NEAR(dark.laplacian_variance, bright.laplacian_variance, 0.1 * bright.laplacian_variance);
  EXPECT_NEAR(dark.fine_share, bright.fine_share, 0.1 * bright.fine_share);
}

TEST(Sharpness, AWallSaysNothing) {
  EXPECT_FALSE(is_sharp(sharpness(cv::Mat(100, 100, CV_8UC3, cv::Scalar(200, 200, 200)))));
  EXPECT_FALSE(is_sharp(sharpness(cv::Mat(4, 100, CV_8U, cv::Scalar(200)))));
}

}  // namespace
}  // namespace lapwing::vision
