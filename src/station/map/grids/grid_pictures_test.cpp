#include "station/map/grids/grid_pictures.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/async/scope.hpp"
#include "station/map/grids/grid_routes.hpp"
#include "station/testing/grid_demo.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using testing::floor_grid;
using testing::header;
using testing::put_tiles;

struct GridPicturesTest : ::testing::Test, testing::MapDemo {
  GridPicturesTest() { add_grid_routes(router, loop, live, pictures, nullptr, "run"); }
  [[nodiscard]] static map::XyzTile home_tile(int zoom = 18) {
    // In which the one cell is that is taken, 64 m east and north of the anchor.
    return tile_at(zoom, testing::yard_anchor.lon_deg() + 64.0 / 76'057.0,
                   testing::yard_anchor.lat_deg() + 64.0 / 111'170.0);
  }
  static std::string path(map::XyzTile const& tile, std::string_view query = "") {
    return fmt::format("/api/v1/grids/yard/0/floor/tiles/{}/{}/{}.png{}", tile.zoom, tile.x, tile.y, query);
  }
  HttpResponse get(std::string const& target, std::vector<HttpHeader> headers = {}) {
    return testing::ask(loop, router, "GET", target, {}, std::move(headers));
  }
  base::Task<> fetch(map::XyzTile tile) { (void)co_await pictures.picture(floor_grid, tile); }

  GridPictures pictures{loop, live, std::make_shared<GridPlaces>(live), {.most_bytes = 20'000, .most_jobs = 2}};
  Router router;
};

TEST_F(GridPicturesTest, AreDrawnOnceUntilTheyChange) {
  put_tiles(*this, {{0, 0}}, now());
  auto const first = get(path(home_tile()));
  EXPECT_EQ(first.status, 200);
  EXPECT_EQ(first.content_type, "image/png");
  EXPECT_TRUE(first.body.starts_with("\x89PNG"));
  EXPECT_EQ(get(path(home_tile())).body, first.body);
  EXPECT_EQ(pictures.drawn(), 1U);
  put_tiles(*this, {{5, 5}}, now() + 1s);
  EXPECT_EQ(get(path(home_tile())).status, 200);
  EXPECT_EQ(pictures.drawn(), 1U) << "what changed is elsewhere";
  map::OccupancyGrid grid(0.5);
  for (int i = 0; i < 200; ++i) grid.set({i, 60}, map::Evidence::of_probability(0.99));
  ASSERT_TRUE(live.put_tiles(floor_grid, grid, {{0, 0}}, {"robot 1", now() + 2s}));
  EXPECT_NE(get(path(home_tile())).body, first.body);
  EXPECT_EQ(pictures.drawn(), 2U);
}

TEST_F(GridPicturesTest, AreDrawnAnewWhereTheirSiteMoves) {
  put_tiles(*this, {{0, 0}}, now());
  auto const there = get(path(home_tile(20)));
  live.put_site(testing::yard(geo::Wgs84::from_degrees(47.0001, 8.0001)));
  EXPECT_NE(get(path(home_tile(20))).body, there.body);
}

TEST_F(GridPicturesTest, MayBeKeptByTheirRevision) {
  put_tiles(*this, {{0, 0}}, now());
  auto const kept = [&](std::string_view query) { return header(get(path(home_tile(), query)), "Cache-Control"); };
  EXPECT_EQ(kept(fmt::format("?revision=run-{}", live.revision())), "private, max-age=31536000, immutable");
  EXPECT_EQ(kept(""), "private, no-cache");
  EXPECT_EQ(kept("?revision=5"), "private, no-cache");
  EXPECT_EQ(kept(fmt::format("?revision=other-{}", live.revision())), "private, no-cache")
      << "of a run before this one";
  EXPECT_EQ(kept(fmt::format("?revision=run-{}", live.revision() + 1)), "private, no-cache") << "not yet";
  auto const tag = header(get(path(home_tile())), "ETag");
  EXPECT_EQ(get(path(home_tile()), {{"If-None-Match", tag}}).status, 304);
  put_tiles(*this, {{0, 0}}, now() + 1s);
  EXPECT_EQ(get(path(home_tile()), {{"If-None-Match", tag}}).status, 200);
}

TEST_F(GridPicturesTest, AreEmptyWhereNothingIsKnown) {
  put_tiles(*this, {{0, 0}}, now());
  auto const elsewhere = tile_at(18, 100.0, 0.0);
  EXPECT_EQ(pictures.revision_of(floor_grid, elsewhere), 0U);
  EXPECT_EQ(get(path(elsewhere)).status, 200) << "programs that draw maps take an error for a broken server";
  EXPECT_GT(pictures.revision_of(floor_grid, {0, 0, 0}), 0U);
  EXPECT_GT(pictures.revision_of(floor_grid, home_tile(24)), 0U);
  EXPECT_GT(pictures.revision_of(floor_grid, home_tile(3)), 0U);
}

TEST_F(GridPicturesTest, AreAFewAtOnceAndOneOfEach) {
  put_tiles(*this, {{0, 0}}, now());
  base::Scope scope(loop);
  for (int i = 0; i < 5; ++i) scope.spawn(fetch(home_tile()));
  for (int zoom = 12; zoom < 18; ++zoom) scope.spawn(fetch(home_tile(zoom)));
  EXPECT_LE(loop.jobs_on_pool(), 2U);
  loop.run_until_done(scope.join());
  EXPECT_EQ(pictures.drawn(), 7U) << "who asks for the same waits for the same";
}

TEST_F(GridPicturesTest, DoNotWaitForWhoHasGone) {
  put_tiles(*this, {{0, 0}}, now());
  {
    base::Scope scope(loop);
    scope.spawn(fetch(home_tile(15)));
    scope.spawn(fetch(home_tile(16)));
  }
  EXPECT_EQ(get(path(home_tile(15))).status, 200);
  EXPECT_EQ(get(path(home_tile(17))).status, 200);
}

TEST_F(GridPicturesTest, AreKeptWithinALimit) {
  put_tiles(*this, {{0, 0}}, now());
  for (int zoom = map::lowest_zoom; zoom <= map::highest_zoom; ++zoom)
    for (int dx = 0; dx < 3; ++dx) {
      auto tile = home_tile(zoom);
      tile.x += dx;
      (void)get(path(tile));
      EXPECT_LE(pictures.kept_bytes(), 20'000U);
    }
  EXPECT_GT(pictures.kept_bytes(), 1'000U);
}

TEST_F(GridPicturesTest, SayWhatThereIsNot) {
  put_tiles(*this, {{0, 0}}, now());
  EXPECT_EQ(get("/api/v1/grids/yard/0/none/tiles/1/0/0.png").status, 404);
  EXPECT_EQ(get("/api/v1/grids/yard/-/floor/tiles/1/0/0.png").status, 404) << "that is the site's ground";
  EXPECT_EQ(get("/api/v1/grids/yard/0/floor/tiles/1/2/0.png").status, 404);
  EXPECT_EQ(get("/api/v1/grids/yard/0/floor/tiles/26/0/0.png").status, 404);
  EXPECT_EQ(get("/api/v1/grids/yard/0/floor/tiles/1/x/0.png").status, 404);
  EXPECT_EQ(get("/api/v1/grids/yard/0/none/tiles.json").status, 404);
}

TEST_F(GridPicturesTest, AreToldOfAsTileJson) {
  put_tiles(*this, {{0, 0}}, now(), {"yard", "", "car park"});
  auto const told = json::parse(get("/api/v1/grids/yard/-/car%20park/tiles.json").body);
  EXPECT_EQ(told["tilejson"], "3.0.0");
  EXPECT_EQ(told["tiles"][0], "http://station:8080/api/v1/grids/yard/-/car%20park/tiles/{z}/{x}/{y}.png");
  EXPECT_EQ(told["maxzoom"], 18) << "0.41 m a pixel";
  EXPECT_EQ(told["bounds"].size(), 4U);
  auto const grids = json::parse(get("/api/v1/grids").body)["grids"];
  ASSERT_EQ(grids.size(), 1U);
  EXPECT_EQ(grids[0]["name"], "car park");
}

}  // namespace
}  // namespace lapwing::station
