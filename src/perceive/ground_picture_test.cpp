#include "perceive/ground_picture.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::perceive {
namespace {

/// Draws a disc of the ground as a camera sees it.
cv::Mat picture_of_disc(geo::GroundView const& view, map::SitePoint const& middle, double radius_m) {
  cv::Mat picture(view.lens.height_px, view.lens.width_px, CV_8UC3, cv::Scalar::all(60));
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      auto const ground = geo::ground_at(view, {column + 0.5, row + 0.5});
      if (ground && geo::distance_m(*ground, middle) < radius_m)
        picture.at<cv::Vec3b>(row, column) = cv::Vec3b(250, 250, 250);
    }
  }
  return picture;
}

struct Disc {
  map::SitePoint middle;
  double area_m2;
};
Disc disc_in(GroundPicture const& ground) {
  cv::Mat shades;
  cv::cvtColor(ground.pixels, shades, cv::COLOR_BGR2GRAY);
  auto const moments = cv::moments(shades > 155, true);
  double const metres = ground.metres_a_pixel;
  constexpr double half = 0.5;
  return {ground.ground({metres * (moments.m10 / moments.m00 + half), metres * (moments.m01 / moments.m00 + half)}),
          moments.m00 * metres * metres};
}

struct Case {
  char const* what;
  double yaw_rad, tilt_rad, roll_rad, height_m;
  double k1;
};

class GroundPictures : public testing::TestWithParam<Case> {};

TEST_P(GroundPictures, AreTrueInEveryPart) {
  auto const& the = GetParam();
  auto lens = geo::pinhole(640, 480, 1.1);
  lens.k1 = the.k1;
  geo::GroundView const view{
      .lens = lens,
      .site_from_camera = geo::camera_at({30.0, -20.0, 2.0 + the.height_m}, the.yaw_rad, the.tilt_rad, the.roll_rad),
      .ground_up_m = 2.0};
  auto const below = geo::ground_at(view, {180.0, 330.0});
  ASSERT_TRUE(below);
  constexpr double radius_m = 0.8;
  auto const ground = ground_picture(picture_of_disc(view, *below, radius_m), view, {});
  ASSERT_TRUE(ground);
  auto const disc = disc_in(*ground);
  EXPECT_LT(geo::distance_m(disc.middle, *below), 0.02);
  EXPECT_NEAR(disc.area_m2, std::numbers::pi * radius_m * radius_m, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Of, GroundPictures,
                         testing::Values(Case{"below", 0.4, 0.0, 0.0, 10.0, 0.0},
                                         Case{"leaning", 2.0, 0.25, 0.15, 12.0, 0.0},
                                         Case{"bent", -1.0, 0.1, 0.0, 9.0, -0.12},
                                         Case{"low", 0.0, 0.0, 0.0, 4.0, 0.0}),
                         [](auto const& one) { return one.param.what; });

TEST(GroundPicture, IsNoFinerThanPaintNeeds) {
  geo::GroundView const low{.lens = geo::pinhole(1280, 720, 1.0), .site_from_camera = geo::camera_at({0, 0, 5}, 0, 0)};
  cv::Mat const picture(720, 1280, CV_8UC3, cv::Scalar::all(90));
  auto const ground = ground_picture(picture, low, {});
  ASSERT_TRUE(ground);
  EXPECT_DOUBLE_EQ(ground->metres_a_pixel, 0.025);
  geo::GroundView high = low;
  high.site_from_camera = geo::camera_at({0, 0, 60}, 0, 0);
  EXPECT_GT(ground_picture(picture, high, {})->metres_a_pixel, 0.05);
}

TEST(GroundPicture, IsNoneWhereNoGroundIsSeenWellEnough) {
  cv::Mat const picture(480, 640, CV_8UC3, cv::Scalar::all(90));
  auto const lens = geo::pinhole(640, 480, 1.0);
  EXPECT_FALSE(ground_picture(picture, {.lens = lens, .site_from_camera = geo::camera_at({0, 0, -1}, 0, 0)}, {}));
  EXPECT_FALSE(ground_picture(picture, {.lens = lens, .site_from_camera = geo::camera_at({0, 0, 900}, 0, 0)}, {}));
  EXPECT_FALSE(ground_picture({}, {.lens = lens, .site_from_camera = geo::camera_at({0, 0, 10}, 0, 0)}, {}));
}

}  // namespace
}  // namespace lapwing::perceive
