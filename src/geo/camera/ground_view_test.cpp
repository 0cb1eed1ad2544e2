#include "geo/camera/ground_view.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::geo {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double far_m = 200.0;

/// 90 degrees across and 53 high: at 10 m it sees 20 m by 10 m.
GroundView view_of(double yaw_rad, double tilt_rad, double roll_rad = 0.0) {
  return {.lens = pinhole(1000, 500, pi / 2.0),
          .site_from_camera = camera_at({100.0, 50.0, 12.0}, yaw_rad, tilt_rad, roll_rad),
          .ground_up_m = 2.0};
}

void expect_near(Point<SiteFrame> const& place, double x, double y) {
  EXPECT_NEAR(place.x(), x, 1e-9);
  EXPECT_NEAR(place.y(), y, 1e-9);
}

TEST(GroundView, StraightDownTheUpperEdgePointsWhereTheYawDoes) {
  auto const east = footprint_corners(view_of(0.0, 0.0));
  ASSERT_TRUE(east);
  expect_near((*east)[0], 105.0, 60.0);  // upper left: ahead, and left of that
  expect_near((*east)[1], 105.0, 40.0);
  expect_near((*east)[2], 95.0, 40.0);
  expect_near((*east)[3], 95.0, 60.0);
  auto const north = footprint_corners(view_of(pi / 2.0, 0.0));
  ASSERT_TRUE(north);
  expect_near((*north)[0], 90.0, 55.0);
  expect_near((*north)[1], 110.0, 55.0);
}

TEST(GroundView, TiltLooksAheadAndSeesATrapezoid) {
  auto const view = view_of(pi / 2.0, pi / 4.0);
  auto const middle = ground_at(view, {500.0, 250.0});
  ASSERT_TRUE(middle);
  expect_near(*middle, 100.0, 60.0);
  auto const corners = footprint_corners(view);
  ASSERT_TRUE(corners);
  EXPECT_NEAR((*corners)[0].y(), 50.0 + 10.0 * std::tan(pi / 4.0 + std::atan(0.5)), 1e-9);
  EXPECT_GT((*corners)[1].x() - (*corners)[0].x(), (*corners)[2].x() - (*corners)[3].x());
}

TEST(GroundView, RollTurnsTheCameraClockwise) {
  auto const up = ground_at(view_of(0.0, 0.0, pi / 2.0), {500.0, 0.0});
  ASSERT_TRUE(up);
  expect_near(*up, 100.0, 45.0);  // the upper edge, east without roll, is south with a quarter turn
}

TEST(GroundView, ThePlaceOfAPixelIsDrawnInThatPixel) {
  auto view = view_of(0.7, 0.5, 0.2);
  view.lens.k1 = -0.1;
  view.lens.p1 = 0.002;
  for (double x = 0.0; x <= 1000.0; x += 125.0) {
    for (double y = 5.0; y < 500.0; y += 70.0) {
      auto const ground = ground_at(view, {x, y});
      ASSERT_TRUE(ground);
      auto const pixel = seen_at(view, *ground);
      if (x > 0.0 && x < 1000.0) {
        ASSERT_TRUE(pixel) << x << ' ' << y;
        EXPECT_NEAR(pixel->x, x, 1e-6);
        EXPECT_NEAR(pixel->y, y, 1e-6);
      }
    }
  }
  EXPECT_FALSE(seen_at(view, {0.0, 0.0}));
}

TEST(GroundView, TheSkyIsNoGround) {
  auto const level = view_of(0.0, pi / 2.0);
  EXPECT_FALSE(ground_at(level, {500.0, 100.0}));
  EXPECT_TRUE(ground_at(level, {500.0, 400.0}));
  EXPECT_FALSE(footprint_corners(level));
  EXPECT_FALSE(ground_sampling(level, {500.0, 100.0}));
  EXPECT_TRUE(footprint(view_of(0.0, pi), far_m).empty());
  auto below = view_of(0.0, 0.0);
  below.ground_up_m = 20.0;
  EXPECT_FALSE(ground_at(below, {500.0, 250.0}));
  EXPECT_TRUE(footprint(below, far_m).empty());
}

TEST(GroundView, TheFootprintIsCutOffBeforeTheHorizon) {
  auto const level = footprint(view_of(0.0, pi / 2.0), far_m);
  ASSERT_GE(level.size(), 4U);
  double farthest_m = 0.0;
  for (auto const& place : level) {
    farthest_m = std::max(farthest_m, distance_m(place, {100.0, 50.0}));
    EXPECT_GT(place.x(), 100.0);
  }
  EXPECT_NEAR(farthest_m, far_m, 0.01);
  EXPECT_FALSE(polygon_fault(Polygon<SiteFrame>{{level}}));
}

TEST(GroundView, WithoutHorizonTheFootprintIsTheQuadrilateral) {
  auto const view = view_of(0.3, 0.4);
  auto const corners = *footprint_corners(view);
  Polygon<SiteFrame> const four{{{corners.begin(), corners.end()}}};
  Polygon<SiteFrame> const all{{footprint(view, far_m)}};
  EXPECT_NEAR(area_m2(all), area_m2(four), 1e-6);
}

TEST(GroundView, EveryGroundPixelLiesWithinTheFootprint) {
  for (double const tilt : {0.0, 0.5, 1.2, 1.5}) {
    auto const view = view_of(1.1, tilt, 0.1);
    Polygon<SiteFrame> const outline{{footprint(view, far_m)}};
    for (double x = 3.0; x < 1000.0; x += 71.0) {
      for (double y = 3.0; y < 500.0; y += 41.0) {
        auto const ground = ground_at(view, {x, y});
        // The cut across the far end is a straight line; what lies beyond it may be left out.
        if (ground && distance_m(*ground, {100.0, 50.0}) < 0.5 * far_m) {
          EXPECT_TRUE(contains(outline, *ground)) << tilt << ' ' << x << ' ' << y;
        }
      }
    }
  }
}

TEST(GroundView, SamplingIsHeightOverFocalLengthAndGrowsAslant) {
  auto const down = ground_sampling(view_of(0.4, 0.0), {500.0, 250.0});
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->finest_m, 10.0 / 500.0, 1e-9);
  EXPECT_NEAR(down->coarsest_m, 10.0 / 500.0, 1e-9);
  // At a tilt t in the middle: h / (f cos t) across, h / (f cos^2 t) along.
  auto const aslant = ground_sampling(view_of(0.4, pi / 3.0), {500.0, 250.0});
  ASSERT_TRUE(aslant);
  EXPECT_NEAR(aslant->finest_m, 0.04, 1e-6);
  EXPECT_NEAR(aslant->coarsest_m, 0.08, 1e-5);
}

TEST(GroundView, UnevenGroundIsMetWhereItIsMetFirst) {
  auto const view = view_of(0.0, pi / 4.0);
  auto const level = ground_at(view, {500.0, 250.0}, [](auto const&) { return 2.0; });
  ASSERT_TRUE(level);
  EXPECT_NEAR(level->x(), 110.0, 1e-6);
  // A wall of earth 4 m ahead of the camera that is higher than the ray there.
  auto const bank = ground_at(view, {500.0, 250.0}, [](auto const& at) { return at.x() > 104.0 ? 9.0 : 2.0; });
  ASSERT_TRUE(bank);
  EXPECT_NEAR(bank->x(), 104.0, 1e-6);
  auto const slope = ground_at(view, {500.0, 250.0}, [](auto const& at) { return 2.0 + 0.5 * (at.x() - 100.0); });
  ASSERT_TRUE(slope);
  EXPECT_NEAR(slope->x(), 100.0 + 10.0 / 1.5, 1e-6);
  EXPECT_FALSE(ground_at(view, {500.0, 250.0}, [](auto const&) { return -1e6; }));
}

}  // namespace
}  // namespace lapwing::geo
