#include "map/features/placement.hpp"

#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::map {
namespace {

geo::Site site_at(double lat_deg, double lon_deg) {
  return *geo::Site::make("site", geo::Wgs84::from_degrees(lat_deg, lon_deg, 90.0));
}

TEST(Placement, ComesBackWhereItWas) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-farthest_m, farthest_m);
  for (auto const& site : {site_at(41.0, -8.0), site_at(-60.0, 179.999), site_at(0.0, -180.0), site_at(0.0, 0.0)}) {
    for (int i = 0; i < 200; ++i) {
      SitePoint const point(any(random), any(random));
      auto const place = place_of(site, point);
      EXPECT_LT(geo::distance_m(point_of(site, place.lon_rad, place.lat_rad), point), 1e-6);
      EXPECT_LT(geo::distance_m(point_of(site, place.lon_rad + 2.0 * std::numbers::pi, place.lat_rad), point), 1e-6);
    }
  }
}

TEST(Placement, KeepsLongitudesTogetherAcrossTheAntimeridian) {
  auto const site = site_at(10.0, 179.9999);
  auto const east = place_of(site, {1000.0, 0.0});
  auto const west = place_of(site, {-1000.0, 0.0});
  EXPECT_NEAR(east.lon_deg() - west.lon_deg(), 2000.0 / 109'639.0, 1e-5);
  EXPECT_GT(east.lon_deg(), 180.0);
}

TEST(Placement, PutsWhatLiesElsewhereFarOff) {
  auto const site = site_at(41.0, -8.0);
  for (auto const place : {geo::Wgs84::from_degrees(-41.0, 172.0), geo::Wgs84::from_degrees(41.0, 172.0),
                           geo::Wgs84::from_degrees(30.0, -8.0), geo::Wgs84::from_degrees(42.0, -8.0)}) {
    auto const point = point_of(site, place.lon_rad, place.lat_rad);
    EXPECT_GT(geo::distance_m(point, SitePoint()), farthest_m) << place.lat_deg();
  }
}

}  // namespace
}  // namespace lapwing::map
