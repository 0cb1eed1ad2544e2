#include "map/grid/grid_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "map/features/placement.hpp"

namespace lapwing::map {
namespace {

using GridPlace = geo::Transform<geo::SiteFrame, GridFrame>;

auto const taken = Evidence::of_probability(0.95);
auto const free_space = Evidence::of_probability(0.1);

geo::Site site_at(double lat_deg, double lon_deg) {
  return *geo::Site::make("yard", geo::Wgs84::from_degrees(lat_deg, lon_deg, 90.0));
}

struct PixelOfTile {
  XyzTile tile;
  double x = 0.0;
  double y = 0.0;
};

/// By the formula of web maps, as everybody writes it.
PixelOfTile pixel_at(geo::Wgs84 place, int zoom) {
  double const across = std::pow(2.0, zoom);
  double const x = (place.lon_deg() + 180.0) / 360.0 * across;
  double const y =
      (1.0 - std::log(std::tan(place.lat_rad) + 1.0 / std::cos(place.lat_rad)) / std::numbers::pi) / 2.0 * across;
  double const turned = x - across * std::floor(x / across);
  return {{zoom, static_cast<std::int64_t>(turned), static_cast<std::int64_t>(y)},
          (turned - std::floor(turned)) * tile_px,
          (y - std::floor(y)) * tile_px};
}

Shade at(std::vector<Shade> const& picture, int x, int y) {
  return picture[static_cast<std::size_t>(y) * tile_px + static_cast<std::size_t>(x)];
}

TEST(Shade, TellsHowLikelyACellIsTaken) {
  EXPECT_EQ(shade_of(Evidence()), 0);
  EXPECT_EQ(probability_of(0), std::nullopt);
  EXPECT_EQ(shade_of(Evidence::of_probability(0.0)), 127);
  EXPECT_EQ(shade_of(Evidence::of_probability(1.0)), 255);
  EXPECT_EQ(shade_of(Evidence::of_probability(0.5)), 1) << "seen, and no more";
  for (int percent = 0; percent <= 100; ++percent) {
    double const p = percent / 100.0;
    EXPECT_NEAR(*probability_of(shade_of(Evidence::of_probability(p))), p, 0.004);
  }
  EXPECT_GT(shade_of(taken), shade_of(Evidence::of_probability(0.6))) << "the surer one is shown";
  EXPECT_GT(shade_of(free_space), shade_of(Evidence::of_probability(0.4)));
  EXPECT_GT(shade_of(Evidence::of_probability(0.51)), shade_of(Evidence::of_probability(0.0)));
}

TEST(GridPyramid, ShowsTheGreatestShadeAtEachLevel) {
  OccupancyGrid grid(0.1);
  std::mt19937 random(50);
  for (int i = 0; i < 3'000; ++i)
    grid.set({static_cast<int>(random() % 256), static_cast<int>(random() % 256)},
             Evidence::of_log_odds(random() % 2 ? 2.0 : -2.0));
  GridPyramid const pyramid(grid);
  auto const* tile = pyramid.tile({0, 0});
  ASSERT_TRUE(tile);
  for (int level = 0; level < GridPyramid::levels; ++level) {
    int const side = tile_cells >> level;
    ASSERT_EQ(tile->level(level).size(), static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    std::vector<Shade> expected(tile->level(level).size());
    for (int y = 0; y < tile_cells; ++y) {
      for (int x = 0; x < tile_cells; ++x) {
        int const index = (y >> level) * side + (x >> level);
        auto& shade = expected[static_cast<std::size_t>(index)];
        shade = std::max(shade, shade_of(grid.at({x, y})));
      }
    }
    EXPECT_TRUE(std::ranges::equal(tile->level(level), expected)) << level;
  }
  EXPECT_EQ(pyramid.tile({1, 0}), nullptr);
}

TEST(GridPyramid, TakesWhatHasNotChangedFromBefore) {
  OccupancyGrid grid(0.1);
  grid.set({1, 1}, taken);
  grid.set({300, 1}, taken);
  GridPyramid const before(grid);
  grid.set({300, 1}, free_space);
  grid.set({600, 1}, free_space);
  GridPyramid const after(grid, before);
  EXPECT_EQ(after.tile({0, 0}), before.tile({0, 0}));
  EXPECT_NE(after.tile({1, 0}), before.tile({1, 0}));
  EXPECT_EQ(before.tile({1, 0})->level(0)[256 + 44], shade_of(taken)) << "what is drawn from does not change";
  EXPECT_EQ(after.tile({1, 0})->level(0)[256 + 44], shade_of(free_space));
  EXPECT_TRUE(after.tile({2, 0}));
  EXPECT_EQ(GridPyramid().extent(), std::nullopt);
}

/// Pixels that show something else than the cell in their middle.
int wrong_pixels(std::vector<Shade> const& picture, OccupancyGrid const& grid, geo::Site const& site, XyzTile tile,
                 int zoom) {
  int wrong = 0;
  double const world_px = std::ldexp(tile_px, zoom);
  for (int y = 0; y < tile_px; ++y) {
    for (int x = 0; x < tile_px; ++x) {
      double const east = (static_cast<double>(tile.x) * tile_px + x + 0.5) / world_px;
      double const south = (static_cast<double>(tile.y) * tile_px + y + 0.5) / world_px;
      double const lon = (2.0 * east - 1.0) * std::numbers::pi;
      double const lat = std::atan(std::sinh(std::numbers::pi * (1.0 - 2.0 * south)));
      auto const point = grid.site_from_grid().inverse() * point_of(site, lon, lat);
      wrong += at(picture, x, y) != shade_of(grid.at(grid.cell_at(point)));
    }
  }
  return wrong;
}

/// Zoomed in, each pixel shows the cell in its middle.
TEST(GridTiles, ShowTheCellInTheMiddleOfAPixel) {
  std::mt19937 random(51);
  for (auto const& site : {site_at(41.0, -8.6), site_at(-33.9, 151.2), site_at(64.0, 180.0)}) {
    OccupancyGrid grid(0.2, GridPlace({30.0, -20.0}, 0.7));
    for (int x = -200; x < 400; ++x)
      for (int y = -200; y < 400; ++y)
        if (random() % 4) grid.set({x, y}, random() % 2 ? taken : free_space);
    GridPyramid const pyramid(grid);
    for (int const zoom : {22, 23, 25}) {
      auto const middle = pixel_at(place_of(site, grid.site_from_grid() * geo::Point<GridFrame>(10.0, 10.0)), zoom);
      auto const picture = render(pyramid, site, middle.tile);
      ASSERT_TRUE(picture);
      int const wrong = wrong_pixels(*picture, grid, site, middle.tile, zoom);
      EXPECT_LT(wrong, 20) << "of 65536, by rounding at the edges of cells, at zoom " << zoom;
    }
  }
}

/// Zoomed out, one taken cell in a free hall is seen, wherever it is and however the grid lies.
TEST(GridTiles, ShowEveryTakenCellHoweverFarAway) {
  std::mt19937_64 random(52);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int i = 0; i < 150; ++i) {
    double const lat_deg = 120.0 * (any(random) - 0.5);
    auto const site = site_at(lat_deg, 360.0 * (any(random) - 0.5));
    double const east_m = 100.0 * any(random);
    double const north_m = 100.0 * any(random);
    OccupancyGrid grid(0.05, GridPlace({east_m, north_m}, 7.0 * any(random)));
    Cell const post{static_cast<int>(random() % 600) - 300, static_cast<int>(random() % 600) - 300};
    for (int x = -2; x < 2; ++x)
      for (int y = -2; y < 2; ++y) std::ranges::fill(grid.tile_to_write({x, y}).cells, free_space);
    grid.set(post, taken);
    int const zoom = lowest_zoom + i % 12;
    auto const where = pixel_at(place_of(site, grid.site_from_grid() * grid.centre_of(post)), zoom);
    auto const picture = render(GridPyramid(grid), site, where.tile);
    ASSERT_TRUE(picture) << zoom;
    Shade seen = 0;
    for (int y = static_cast<int>(where.y) - 1; y <= where.y + 1.0; ++y)
      for (int x = static_cast<int>(where.x) - 1; x <= where.x + 1.0; ++x)
        if (x >= 0 && y >= 0 && x < tile_px && y < tile_px) seen = std::max(seen, at(*picture, x, y));
    bool const is_at_the_edge = where.x < 1.0 || where.y < 1.0 || where.x > 255.0 || where.y > 255.0;
    EXPECT_TRUE(seen == shade_of(taken) || is_at_the_edge) << "case " << i << " at zoom " << zoom;
    // A square of 1.12 pixels and more, turned by 18 degrees, reaches into all four neighbours of a pixel.
    EXPECT_LE(std::ranges::count(*picture, shade_of(taken)), 5) << "and not as more than it is";
  }
}

TEST(GridTiles, ShowNothingWhereNothingIs) {
  auto const site = site_at(41.0, -8.6);
  OccupancyGrid grid(0.1);
  grid.set({0, 0}, taken);
  auto const home = pixel_at(site.anchor(), 20).tile;
  EXPECT_TRUE(render(GridPyramid(grid), site, home));
  EXPECT_FALSE(render(GridPyramid(), site, home));
  EXPECT_FALSE(render(GridPyramid(grid), site, {20, home.x + 3, home.y}));
  EXPECT_FALSE(render(GridPyramid(grid), site, {9, home.x >> 11, home.y >> 11})) << "too far out";
  EXPECT_FALSE(render(GridPyramid(grid), site, {26, home.x << 6, home.y << 6}));
  EXPECT_FALSE(render(GridPyramid(grid), site, {20, -1, home.y}));
  EXPECT_FALSE(render(GridPyramid(grid), site, {20, home.x, std::int64_t{1} << 20}));
  EXPECT_TRUE(is_drawn(home));
}

/// Whatever tile of the map shows anything of a tile of the grid is among those that are named, and few others.
TEST(GridTiles, AreDrawnAnewWhereTheGridChanged) {
  for (auto const& site : {site_at(41.0, -8.6), site_at(10.0, 179.9999)}) {
    OccupancyGrid grid(0.1, GridPlace({5.0, 7.0}, 0.5));
    std::ranges::fill(grid.tile_to_write({0, 0}).cells, taken);
    GridPyramid const pyramid(grid);
    for (int const zoom : {12, 17, 20, 21}) {
      std::vector<TileKey> const changed = {{0, 0}};
      auto const named = tiles_with(grid.resolution_m(), grid.site_from_grid(), changed, site, zoom, 1'000);
      ASSERT_FALSE(named.empty());
      EXPECT_TRUE(std::ranges::is_sorted(named));
      auto const shown =
          std::ranges::count_if(named, [&](XyzTile tile) { return render(pyramid, site, tile).has_value(); });
      EXPECT_GE(2 * shown, std::ranges::ssize(named)) << zoom;
      auto const middle =
          pixel_at(place_of(site, grid.site_from_grid() * geo::Point<GridFrame>(12.8, 12.8)), zoom).tile;
      std::int64_t found = 0;
      auto const across = std::int64_t{1} << zoom;
      for (std::int64_t x = -4; x <= 4; ++x)
        for (std::int64_t y = -4; y <= 4; ++y)
          found += render(pyramid, site, {zoom, (middle.x + x + across) % across, middle.y + y}).has_value();
      EXPECT_EQ(found, shown) << "none is missing, at zoom " << zoom;
    }
    std::vector<TileKey> const changed = {{0, 0}, {1, 0}};
    EXPECT_EQ(tiles_with(grid.resolution_m(), grid.site_from_grid(), changed, site, 25, 7).size(), 7U);
  }
}

}  // namespace
}  // namespace lapwing::map
