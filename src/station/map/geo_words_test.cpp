#include "station/map/geo_words.hpp"

#include <gtest/gtest.h>

#include "base/text/utc_text.hpp"
#include "map/features/placement.hpp"
#include "station/map/grids/web_mercator.hpp"

namespace lapwing::station {
namespace {

geo::Site site_at(double lat_deg, double lon_deg) {
  return geo::Site::make("s", geo::Wgs84::from_degrees(lat_deg, lon_deg)).value();
}

TEST(LonLatBox, IsReadAsAddressesTellIt) {
  EXPECT_EQ(lon_lat_box("7.5,46.5,8,47"), (LonLatBox{7.5, 46.5, 8.0, 47.0}));
  EXPECT_EQ(lon_lat_box("7.5,46.5,-10,8,47,1000"), (LonLatBox{7.5, 46.5, 8.0, 47.0})) << "heights are passed over";
  EXPECT_EQ(lon_lat_box("179,-1,-179,1"), (LonLatBox{179.0, -1.0, -179.0, 1.0}));
  for (auto const* text : {"", "1,2,3", "1,2,3,4,5", "1,2,3,4,5,6,7", "1,2,x,4", "1,2,3,", "nan,2,3,4", "1,inf,3,4",
                           "1e400,2,3,4", "0,10,1,9", "-181,0,1,1", "0,0,1,91", " 1,2,3,4", "1;2;3;4"})
    EXPECT_FALSE(lon_lat_box(text)) << text;
}

TEST(LonLatBox, MeetsAcrossTheAntimeridian) {
  LonLatBox const across{179.0, -1.0, -179.0, 1.0};
  EXPECT_TRUE(across.meets({179.5, 0.0, 179.6, 0.1}));
  EXPECT_TRUE(across.meets({-179.5, 0.0, -179.4, 0.1}));
  EXPECT_TRUE(across.meets({178.0, 0.0, 179.0, 0.1})) << "an edge counts";
  EXPECT_FALSE(across.meets({0.0, 0.0, 1.0, 0.1}));
  EXPECT_FALSE(across.meets({179.5, 2.0, 179.6, 3.0}));
  EXPECT_TRUE(across.meets(across));
}

TEST(Period, IsATimeOrTwo) {
  auto const at = [](char const* text) { return base::utc_from_text(text).value(); };
  auto const day = period("2026-11-21T00:00:00Z/2026-11-22T00:00:00Z");
  ASSERT_TRUE(day);
  EXPECT_TRUE(day->contains(at("2026-11-21T00:00:00Z")));
  EXPECT_TRUE(day->contains(at("2026-11-21T13:00:00+01:00")));
  EXPECT_FALSE(day->contains(at("2026-11-22T00:00:00.001Z")));
  EXPECT_TRUE(period("../2026-11-22T00:00:00Z")->contains(at("1999-01-01T00:00:00Z")));
  EXPECT_TRUE(period("2026-11-22T00:00:00Z/")->contains(at("2099-01-01T00:00:00Z")));
  EXPECT_FALSE(period("2026-11-22T00:00:00Z")->contains(at("2026-11-22T00:00:01Z")));
  EXPECT_TRUE(period("../.."));
  for (auto const* text : {"", "..", "yesterday", "2026-11-22", "2026-11-22T00:00:00Z/2026-11-21T00:00:00Z", "//",
                           "2026-11-22T00:00:00Z/../.."})
    EXPECT_FALSE(period(text)) << text;
}

TEST(SiteReach, HoldsAllThatIsInTheBox) {
  for (auto const& site : {site_at(47.0, 8.0), site_at(-70.0, -120.0), site_at(0.0, 180.0), site_at(0.5, -179.9999)}) {
    auto const inside = map::place_of(site, {3'000.0, -2'000.0});
    double const lon_deg = std::remainder(inside.lon_deg(), 360.0);
    auto const reach =
        reach_of({lon_deg - 0.001, inside.lat_deg() - 0.001, lon_deg + 0.001, inside.lat_deg() + 0.001}, site);
    ASSERT_TRUE(reach.box);
    EXPECT_TRUE(reach.box->contains({3'000.0, -2'000.0}));
    EXPECT_FALSE(reach.box->contains({0.0, 0.0}));
    auto const world = reach_of({-180.0, -90.0, 180.0, 90.0}, site);
    ASSERT_TRUE(world.box);
    EXPECT_TRUE(world.box->contains({50'000.0, -50'000.0}));
  }
}

TEST(SiteReach, IsEmptyElsewhere) {
  EXPECT_TRUE(reach_of({20.0, 46.0, 21.0, 48.0}, site_at(47.0, 8.0)).is_empty);
  EXPECT_TRUE(reach_of({7.0, -48.0, 9.0, -46.0}, site_at(47.0, 8.0)).is_empty);
  EXPECT_FALSE(reach_of({179.0, -1.0, -179.0, 1.0}, site_at(0.0, 180.0)).is_empty);
}

TEST(SiteReach, IsEverythingAtThePoles) {
  auto const reach = reach_of({-10.0, 80.0, 10.0, 90.0}, site_at(89.5, 100.0));
  EXPECT_FALSE(reach.is_empty);
  EXPECT_FALSE(reach.box);
}

TEST(LonLatBounds, WrapWhatLiesAcrossTheAntimeridian) {
  auto const site = site_at(0.0, 180.0);
  auto const box = lon_lat_bounds(map::LineString{{{-1'000.0, 0.0}, {1'000.0, 0.0}}}, site);
  EXPECT_NEAR(box.west, 179.991, 0.001);
  EXPECT_NEAR(box.east, -179.991, 0.001);
  EXPECT_TRUE(box.meets({-179.995, -0.1, -179.99, 0.1}));
}

TEST(WebMercator, TilesTheWorld) {
  EXPECT_EQ(tile_address("1", "1", "0"), (map::XyzTile{1, 1, 0}));
  for (auto const& [z, x, y] : {std::array{"1", "2", "0"},
                                {"1", "0", "-1"},
                                {"26", "0", "0"},
                                {"x", "0", "0"},
                                {"-1", "0", "0"},
                                {"1", "0", "0.5"},
                                {"", "0", "0"},
                                {"1", "99999999999", "0"}})
    EXPECT_FALSE(tile_address(z, x, y)) << z << "/" << x << "/" << y;
  auto const world = bounds_of({0, 0, 0});
  EXPECT_DOUBLE_EQ(world.west, -180.0);
  EXPECT_NEAR(world.north, 85.0511288, 1e-7);
  // Berne at zoom 12, as every web map has it.
  EXPECT_EQ(tile_at(12, 7.4474, 46.9480), (map::XyzTile{12, 2132, 1441}));
  for (int zoom : {0, 5, 18, 24}) {
    auto const tile = tile_at(zoom, 7.4474, 46.9480);
    EXPECT_TRUE(bounds_of(tile).meets({7.4474, 46.9480, 7.4474, 46.9480})) << zoom;
  }
  EXPECT_EQ(tile_at(3, 180.0, -90.0), (map::XyzTile{3, 7, 7}));
}

}  // namespace
}  // namespace lapwing::station
