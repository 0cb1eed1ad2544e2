// Grids look back then as they did then, and what has become of their cells can be seen.
#include "station/past/past_grids.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <random>

#include <fmt/format.h>

#include "station/map/grids/grid_pictures.hpp"
#include "station/map/grids/grid_routes.hpp"
#include "station/past/change_routes.hpp"
#include "station/past/moment_words.hpp"
#include "station/testing/fake_store.hpp"
#include "station/testing/grid_demo.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using testing::floor_grid;
using testing::header;

struct PastGridsTest : ::testing::Test, testing::MapDemo {
  PastGridsTest() {
    store.follow(live);
    add_grid_routes(router, loop, live, pictures, &past, "run");
    add_change_routes(router, loop, &store, &past);
  }
  /// So long ago that it is settled.
  static base::UtcTime second(int number) { return base::UtcTime(1'700'000'000s + 1s * number); }
  static map::XyzTile tile(int zoom, double east_m = 64.0, double north_m = 64.0) {
    return tile_at(zoom, testing::yard_anchor.lon_deg() + east_m / 76'057.0,
                   testing::yard_anchor.lat_deg() + north_m / 111'170.0);
  }
  void write(map::OccupancyGrid const& grid, std::vector<map::TileKey> const& tiles, int at) {
    auto const put = live.put_tiles(floor_grid, grid, tiles, {"robot 1", second(at)});
    ASSERT_TRUE(put) << put.error().message;
  }
  void record(int at) { loop.run_until_done(store.record_grids("s1", second(at))); }
  std::string picture_now(map::XyzTile const& where) {
    return *loop.run_until_done(pictures.picture(floor_grid, where));
  }
  HttpResponse get(std::string const& target, std::vector<HttpHeader> headers = {}) {
    return testing::ask(loop, router, "GET", target, {}, std::move(headers));
  }
  static std::string path(map::XyzTile const& where, int at) {
    return fmt::format("/api/v1/grids/yard/0/floor/tiles/{}/{}/{}.png?revision=x&session=s1&at_ms={}", where.zoom,
                       where.x, where.y, milliseconds_of(second(at)));
  }
  json changes(int from, int to) {
    auto const answer = get(fmt::format("/api/v1/history/s1/changes?from_ms={}&to_ms={}", milliseconds_of(second(from)),
                                        milliseconds_of(second(to))));
    EXPECT_EQ(answer.status, 200) << answer.body;
    return json::parse(answer.body);
  }

  testing::FakeStore store;
  GridPictures pictures{loop, live, std::make_shared<GridPlaces>(live)};
  PastGrids past{loop, store, {.most_moments = 3, .most_tiles = 5}};
  Router router;
};

TEST_F(PastGridsTest, PicturesOfThePastAreThoseOfThatTime) {
  std::mt19937 random(7);
  auto const below = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
  map::OccupancyGrid grid(0.5);
  std::vector<std::map<map::XyzTile, std::string>> shown;
  std::vector<map::XyzTile> const places = {tile(15), tile(18), tile(20), tile(18, -60.0, 10.0)};
  for (int step = 0; step < 40; ++step) {
    std::vector<map::TileKey> changed;
    for (int i = 0; i <= below(3); ++i) {
      map::TileKey const key{below(3) - 1, below(2)};
      if (below(6) == 0) {
        grid.set_tile(key, nullptr);
      } else {
        for (int cells = 0; cells < 300; ++cells)
          grid.set({key.x * map::tile_cells + below(256), key.y * map::tile_cells + below(256)},
                   map::Evidence::of_probability(below(100) / 99.0));
      }
      changed.push_back(key);
    }
    write(grid, changed, step);
    record(step);
    auto& now_shown = shown.emplace_back();
    for (auto const& place : places) now_shown[place] = picture_now(place);
  }
  for (int turn = 0; turn < 80; ++turn) {
    int const step = below(40);
    for (auto const& place : places) {
      auto const answer = get(path(place, step));
      ASSERT_EQ(answer.status, 200) << answer.body;
      ASSERT_EQ(answer.body == shown[static_cast<std::size_t>(step)][place], true) << step << " zoom " << place.zoom;
    }
  }
}

TEST_F(PastGridsTest, MayBeKeptByBrowsersAndAreReadOnce) {
  testing::put_tiles(*this, {{0, 0}}, second(0));
  record(0);
  auto const first = get(path(tile(18), 0));
  EXPECT_EQ(header(first, "Cache-Control"), "private, max-age=31536000, immutable");
  EXPECT_EQ(get(path(tile(18), 3), {{"If-None-Match", header(first, "ETag")}}).status, 304) << "the same later";
  get(path(tile(19), 3));
  EXPECT_EQ(store.asked_for_grids, 2U) << "of two moments";
  EXPECT_EQ(store.asked_for_shades, 1U);
}

TEST_F(PastGridsTest, LaterThanTenSecondsAgoThereMayBeMore) {
  auto const at = base::UtcTime(std::chrono::floor<std::chrono::milliseconds>(now()));
  testing::put_tiles(*this, {{0, 0}}, at);
  loop.run_until_done(store.record_grids("s1", at));
  auto const where = tile(18);
  auto const address = fmt::format("/api/v1/grids/yard/0/floor/tiles/{}/{}/{}.png?session=s1&at_ms={}", where.zoom,
                                   where.x, where.y, milliseconds_of(at) + 1);
  EXPECT_EQ(header(get(address), "Cache-Control"), "private, no-cache");
  get(address);
  EXPECT_EQ(store.asked_for_grids, 2U);
}

TEST_F(PastGridsTest, MistakesAreTold) {
  testing::put_tiles(*this, {{0, 0}}, second(5));
  record(5);
  EXPECT_EQ(get(path(tile(18), 0)).status, 404) << "it was not there yet";
  EXPECT_EQ(get("/api/v1/grids/yard/0/floor/tiles/0/0/0.png?session=s1&at_ms=noon").status, 400);
  EXPECT_EQ(get("/api/v1/grids/yard/0/floor/tiles/0/0/0.png?at_ms=1").status, 400);
  EXPECT_EQ(get("/api/v1/grids/yard/0/floor/tiles/99/0/0.png?session=s1&at_ms=1").status, 404);
  EXPECT_EQ(get("/api/v1/history/s1/changes?from_ms=1").status, 400);
  Router without;
  add_change_routes(without, loop, nullptr, nullptr);
  auto const answer = testing::ask(loop, without, "GET", "/api/v1/history/s1/changes?from_ms=1&to_ms=2");
  EXPECT_EQ(answer.status, 404);
  EXPECT_NE(answer.body.find("--store"), std::string::npos);
}

TEST_F(PastGridsTest, ComparesCells) {
  map::OccupancyGrid grid(0.5);
  auto const taken = map::Evidence::of_probability(0.95);
  auto const free = map::Evidence::of_probability(0.05);
  grid.set({10, 10}, taken);
  grid.set({11, 10}, taken);
  grid.set({12, 10}, free);
  grid.set({300, 10}, taken);
  write(grid, {{0, 0}, {1, 0}}, 0);
  record(0);
  grid.set({10, 10}, free);
  grid.set({11, 10}, map::Evidence::of_probability(0.9));  // surer or not, it is taken
  grid.set({12, 10}, taken);
  grid.set({13, 10}, taken);
  grid.set({14, 10}, free);
  write(grid, {{0, 0}}, 1);
  record(1);
  auto const found = changes(0, 1);
  ASSERT_EQ(found["grids"].size(), 1U);
  auto const& change = found["grids"][0];
  EXPECT_EQ(change["name"], "floor");
  EXPECT_EQ(change["taken"], 2);
  EXPECT_EQ(change["freed"], 1);
  EXPECT_EQ(change["other"], 1);
  EXPECT_EQ(change["anew"], false);
  EXPECT_NEAR(change["bounds"][2].get<double>() - change["bounds"][0].get<double>(), 128.0 / 76'057.0, 1e-5)
      << "round the tile that has changed";
  EXPECT_EQ(changes(0, 0)["grids"], json::array());
  EXPECT_EQ(changes(1, 0)["grids"][0]["taken"], 1) << "and the other way round";
}

TEST_F(PastGridsTest, DrawsWhatHasChangedAndNothingElse) {
  map::OccupancyGrid grid(0.5);
  for (int x = 0; x < 256; ++x) grid.set({x, 100}, map::Evidence::of_probability(0.95));
  write(grid, {{0, 0}}, 0);
  record(0);
  grid.set({128, 128}, map::Evidence::of_probability(0.95));
  write(grid, {{0, 0}}, 1);
  record(1);
  auto const draw = [&](int from, int to) {
    auto address = changes(0, 1)["grids"][0]["pictures"].get<std::string>();
    auto const put = [&](std::string const& what, std::string const& with) {
      address.replace(address.find(what), what.size(), with);
    };
    auto const where = tile(18);
    put("{z}", std::to_string(where.zoom));
    put("{x}", std::to_string(where.x));
    put("{y}", std::to_string(where.y));
    put(std::to_string(milliseconds_of(second(0))), std::to_string(milliseconds_of(second(from))));
    put("to_ms=" + std::to_string(milliseconds_of(second(1))), "to_ms=" + std::to_string(milliseconds_of(second(to))));
    return get(address);
  };
  auto const changed = draw(0, 1);
  EXPECT_EQ(changed.status, 200) << changed.body;
  EXPECT_EQ(changed.content_type, "image/png");
  auto const back = draw(1, 0);
  auto const nothing = draw(1, 1);
  EXPECT_NE(changed.body, nothing.body);
  EXPECT_NE(changed.body, back.body) << "what came is not what went";
  EXPECT_NE(changed.body, get(path(tile(18), 1)).body);
  EXPECT_LT(nothing.body.size(), 2'000U);
}

TEST_F(PastGridsTest, AGridThatIsMadeAnewIsComparedWithNothing) {
  testing::put_tiles(*this, {{0, 0}}, second(0));
  record(0);
  testing::put_tiles(*this, {{0, 0}}, second(1), floor_grid, 0.25);
  record(1);
  auto const grid = changes(0, 1)["grids"][0];
  EXPECT_EQ(grid["anew"], true);
  EXPECT_EQ(grid["taken"], 1);
  EXPECT_EQ(grid["freed"], 0);
}

}  // namespace
}  // namespace lapwing::station
