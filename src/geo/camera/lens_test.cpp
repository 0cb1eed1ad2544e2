#include "geo/camera/lens.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::geo {
namespace {

/// A lens as action cameras have it, after calibration.
Lens bending() {
  auto lens = pinhole(1280, 720, 1.5);
  lens.middle = {652.3, 351.8};
  lens.k1 = -0.28;
  lens.k2 = 0.09;
  lens.k3 = -0.012;
  lens.p1 = 0.0011;
  lens.p2 = -0.0007;
  return lens;
}

TEST(Lens, APinholeSeesItsAngleAcross) {
  auto const lens = pinhole(1000, 500, std::numbers::pi / 2.0);
  auto const right = ray_of(lens, {1000.0, 250.0});
  ASSERT_TRUE(right);
  EXPECT_NEAR(right->x(), 1.0, 1e-12);
  EXPECT_NEAR(right->y(), 0.0, 1e-12);
  auto const pixel = pixel_of(lens, {2.0, 1.0, 4.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 750.0, 1e-9);
  EXPECT_NEAR(pixel->y, 375.0, 1e-9);
}

TEST(Lens, BrownsFormulaIsThatOfOpenCv) {
  // By hand: x = 0.3, y = -0.2, r^2 = 0.13.
  Lens const lens{.width_px = 10,
                  .height_px = 10,
                  .focal_x_px = 100.0,
                  .focal_y_px = 200.0,
                  .middle = {5.0, 6.0},
                  .k1 = 0.1,
                  .k2 = 0.02,
                  .k3 = 0.003,
                  .p1 = 0.01,
                  .p2 = 0.02};
  double const radial = 1.0 + 0.1 * 0.13 + 0.02 * 0.13 * 0.13 + 0.003 * 0.13 * 0.13 * 0.13;
  auto const pixel = pixel_of(lens, {0.3, -0.2, 1.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x, 5.0 + 100.0 * (0.3 * radial + 2.0 * 0.01 * 0.3 * -0.2 + 0.02 * (0.13 + 2.0 * 0.09)), 1e-9);
  EXPECT_NEAR(pixel->y, 6.0 + 200.0 * (-0.2 * radial + 0.01 * (0.13 + 2.0 * 0.04) + 2.0 * 0.02 * 0.3 * -0.2), 1e-9);
}

TEST(Lens, EveryPixelsDirectionIsDrawnInThatPixel) {
  auto const lens = bending();
  ASSERT_FALSE(lens_fault(lens)) << *lens_fault(lens);
  for (double x = 0.0; x <= 1280.0; x += 80.0) {
    for (double y = 0.0; y <= 720.0; y += 60.0) {
      auto const ray = ray_of(lens, {x, y});
      ASSERT_TRUE(ray) << x << ' ' << y;
      auto const pixel = pixel_of(lens, Point3<CameraFrame>(ray->x() * 7.0, ray->y() * 7.0, 7.0));
      ASSERT_TRUE(pixel) << x << ' ' << y;
      EXPECT_NEAR(pixel->x, x, 1e-8);
      EXPECT_NEAR(pixel->y, y, 1e-8);
    }
  }
}

TEST(Lens, WhatIsBehindOrBeyondTheFoldIsNotDrawn) {
  EXPECT_FALSE(pixel_of(pinhole(100, 100, 1.0), {0.0, 0.0, -1.0}));
  EXPECT_FALSE(pixel_of(pinhole(100, 100, 1.0), {0.0, 0.0, 0.0}));
  auto folding = pinhole(1000, 1000, 1.0);
  folding.k1 = -0.3;  // it folds where 3 k1 r^2 = -1: at r = 1.05
  EXPECT_TRUE(pixel_of(folding, {1.0, 0.0, 1.0}));
  EXPECT_FALSE(pixel_of(folding, {1.2, 0.0, 1.0}));
}

TEST(Lens, FaultsAreToldInWords) {
  EXPECT_EQ(lens_fault(Lens{}), "its picture has 0 by 0 pixels");
  auto lens = pinhole(640, 480, 1.2);
  EXPECT_FALSE(lens_fault(lens));
  lens.focal_y_px = 0.0;
  EXPECT_EQ(lens_fault(lens), "its focal length is 0 px");
  lens = pinhole(640, 480, 2.4);
  lens.k1 = -0.5;
  ASSERT_TRUE(lens_fault(lens));
  EXPECT_NE(lens_fault(lens)->find("fold"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::geo
