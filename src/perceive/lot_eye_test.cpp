#include "perceive/lot_eye.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::perceive {
namespace {

constexpr double pitch_m = 2.5;
constexpr double mouth_m = 4.0;  // from the upper edge of the picture

/// From 14 m straight down, the upper edge to the north: 16.8 m from west to east and 12.6 m along it.
geo::GroundView view() {
  constexpr double across_rad = 1.08;
  return {.lens = geo::pinhole(640, 480, across_rad),
          .site_from_camera = geo::camera_at({0.0, 0.0, 14.0}, std::numbers::pi / 2.0, 0.0)};
}

/// Paint on asphalt: sides of two rows head to head, of which the lower edge of the picture cuts off the far one.
cv::Mat picture_of_a_row() {
  auto const seen = view();
  double const metres_a_pixel = seen.height_m() / seen.lens.focal_x_px;
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar::all(90));
  constexpr int width_px = 5;
  for (int k = 0; k < 6; ++k) {
    int const x = static_cast<int>((2.0 + k * pitch_m) / metres_a_pixel);
    int const y = static_cast<int>(mouth_m / metres_a_pixel);
    cv::line(picture, {x, y}, {x, picture.rows + width_px}, cv::Scalar::all(225), width_px);
  }
  return picture;
}

TEST(LotEye, SlotsOfARowThatThePictureCutsOffAreAsDeepAsTheyAre) {
  auto eye = LotEye::make("", {}).value();
  auto const sight = eye.look(picture_of_a_row(), view(), base::UtcTime{});
  ASSERT_TRUE(sight);
  ASSERT_EQ(sight->slots.size(), 5U);
  for (auto const& slot : sight->slots) {
    auto const sides = explore::sides_of(slot.outline);
    EXPECT_NEAR(sides.length_m, 5.0, 0.2);
    EXPECT_NEAR(sides.width_m, pitch_m, 0.2);
    EXPECT_NEAR(explore::middle_of(slot.outline).y(), 6.3 - mouth_m - 2.5, 0.2) << "the picture begins 6.3 m north";
  }
}

TEST(LotEye, BareGroundHasNoSlots) {
  auto eye = LotEye::make("", {}).value();
  auto const sight = eye.look(cv::Mat(480, 640, CV_8UC3, cv::Scalar::all(90)), view(), base::UtcTime{});
  ASSERT_TRUE(sight);
  EXPECT_TRUE(sight->slots.empty());
}

TEST(LotEye, APictureOfTheSkyTellsNothing) {
  auto eye = LotEye::make("", {}).value();
  auto up = view();
  up.site_from_camera = geo::camera_at({0.0, 0.0, 14.0}, 0.0, std::numbers::pi);
  EXPECT_FALSE(eye.look(picture_of_a_row(), up, base::UtcTime{}));
}

}  // namespace
}  // namespace lapwing::perceive
