// Whatever is written, the grids of a moment of the past look as they did then.
#include <gtest/gtest.h>

#include <random>

#include <fmt/format.h>

#include "base/testing/temporary_folder.hpp"
#include "base/wall_clock.hpp"
#include "map/store/care/care.hpp"
#include "map/store/past/grid_list.hpp"
#include "map/store/store.hpp"

namespace lapwing::map {
namespace {

using namespace std::chrono_literals;

/// Ten hours before now, by which what is too old is judged.
base::UtcTime const noon = std::chrono::floor<std::chrono::milliseconds>(base::wall_now()) - 10h;

/// A grid as it is shown now; what is not there was never seen.
using Look = std::map<TileKey, TileShades>;

/// What a robot, or several, may do to a map, in any order.
class Writers {
 public:
  explicit Writers(unsigned seed) : random_(seed) {}
  int below(int limit) { return static_cast<int>(random_() % static_cast<unsigned>(limit)); }

  void scribble(OccupancyGrid& grid, std::vector<TileKey>& changed) {
    TileKey const key{below(3) - 1, below(2)};
    int const cells = below(3) == 0 ? 20'000 : 40;
    for (int i = 0; i < cells; ++i)
      grid.set({key.x * tile_cells + below(tile_cells), key.y * tile_cells + below(tile_cells)},
               Evidence::of_probability(below(100) / 99.0));
    changed.push_back(key);
  }

 private:
  std::mt19937 random_;
};

struct PastGridsTest : ::testing::Test {
  PastGridsTest() {
    put_site(47.0);
    open();
  }
  void put_site(double latitude_deg) {
    map.put_site(geo::Site::make("yard", geo::Wgs84::from_degrees(latitude_deg, 8.0)).value());
  }
  void open() {
    store = Store::open(loop, {.address = folder.path().string()}).value();
    store->follow(map);
  }
  template <class T>
  T await(base::Task<T> task) {
    return loop.run_until_done(std::move(task));
  }
  void record(std::string const& session = "today") { await(store->record_grids(session, now)); }

  Look look_now(GridKey const& key) const {
    Look look;
    auto const found = map.grids().find(key);
    if (found == map.grids().end()) return look;
    for (auto const& [at, tile] : found->second.grid.tiles()) look[at] = shades_of(*tile);
    return look;
  }
  Look look_then(GridKey const& key, base::UtcTime at, std::string const& session = "today") {
    auto const grids = await(store->grids_at(session, at));
    EXPECT_TRUE(grids) << grids.error().message;
    auto const grid = grids->find(key);
    if (grid == grids->end()) return {};
    std::vector<std::string> names;
    for (auto const& [tile, name] : grid->second.tiles) names.push_back(name);
    auto const shades = await(store->shades(names));
    EXPECT_TRUE(shades) << shades.error().message;
    Look look;
    for (auto const& [tile, name] : grid->second.tiles) look[tile] = *shades->at(name);
    return look;
  }
  void write(GridKey const& key, OccupancyGrid const& grid, std::vector<TileKey> const& tiles) {
    auto const put = map.put_tiles(key, grid, tiles, {"robot", now});
    ASSERT_TRUE(put) << put.error().message;
  }
  /// Which tiles it was.
  std::vector<TileKey> change_something(Writers& writers, OccupancyGrid& grid, int step) {
    std::vector<TileKey> changed;
    switch (writers.below(8)) {
      case 0: break;  // nothing happens
      case 1:
        changed.push_back({writers.below(3) - 1, writers.below(2)});
        grid.set_tile(changed.back(), nullptr);
        break;
      case 2:
        if (step % 3 == 0) grid = OccupancyGrid(0.05 + 0.01 * writers.below(5));
        writers.scribble(grid, changed);
        break;
      case 3: put_site(47.0 + writers.below(10) * 0.001); break;
      default:
        for (int i = 0; i <= writers.below(3); ++i) writers.scribble(grid, changed);
    }
    return changed;
  }
  std::int64_t rows(std::string const& what) const {
    auto const summary = care::summary(folder.path().string());
    return what == "shades" ? static_cast<std::int64_t>(summary->tile_shades) : 0;
  }

  base::Loop loop{{.unpaced = true, .begins_at = noon}};
  base::testing::TemporaryFolder folder;
  base::UtcTime now = noon;
  LiveMap map{[this] { return now + 1h; }};
  std::unique_ptr<Store> store;
};

TEST_F(PastGridsTest, LookAsTheyDidWhateverWasWritten) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    Writers writers(seed);
    auto const session = fmt::format("session {}", seed);
    std::vector<GridKey> const keys = {{"yard", "", "ground"}, {"yard", "", fmt::format("robot {}", seed)}};
    std::map<GridKey, OccupancyGrid> grids;
    for (auto const& key : keys) grids.emplace(key, OccupancyGrid(0.05));
    std::vector<std::pair<base::UtcTime, std::map<GridKey, Look>>> shown;
    for (int step = 0; step < 60; ++step) {
      now += std::chrono::seconds(writers.below(20) == 0 ? 1000 : 1);
      auto const& key = keys[static_cast<std::size_t>(writers.below(2))];
      auto& grid = grids.at(key);
      auto const changed = change_something(writers, grid, step);
      if (!changed.empty()) write(key, grid, changed);
      record(session);
      auto& look = shown.emplace_back(now, std::map<GridKey, Look>()).second;
      for (auto const& one : keys) look[one] = look_now(one);
    }
    for (auto const& [at, look] : shown)
      for (auto const& key : keys) {
        ASSERT_EQ(look_then(key, at, session) == look.at(key), true) << key.name << " at " << (at - noon) / 1s << " s";
        ASSERT_EQ(look_then(key, at + 900ms, session) == look.at(key), true) << "until the next";
      }
  }
  store.reset();
  auto const verdict = care::verify(folder.path().string());
  ASSERT_TRUE(verdict);
  EXPECT_EQ(verdict->faults, std::vector<std::string>());
}

TEST_F(PastGridsTest, PlacesAreThoseOfThatTime) {
  OccupancyGrid grid(0.05);
  grid.set({1, 1}, Evidence::of_probability(0.9));
  GridKey const key{"yard", "", "ground"};
  write(key, grid, {{0, 0}});
  record();
  now += 1s;
  put_site(48.0);
  record();
  EXPECT_NEAR(await(store->grids_at("today", now - 1s))->at(key).place.anchor.lat_deg(), 47.0, 1e-9);
  EXPECT_NEAR(await(store->grids_at("today", now))->at(key).place.anchor.lat_deg(), 48.0, 1e-9);
  EXPECT_TRUE(await(store->grids_at("today", noon - 1s))->empty());
}

TEST_F(PastGridsTest, WhatLooksAlikeIsKeptOnceAlsoByAnotherSession) {
  OccupancyGrid grid(0.05);
  GridKey const key{"yard", "", "ground"};
  for (int x = 0; x < 10; ++x) grid.set({x * tile_cells + 7, 7}, Evidence::of_probability(0.9));
  std::vector<TileKey> all;
  for (int x = 0; x < 10; ++x) all.push_back({x, 0});
  write(key, grid, all);
  record();
  now += 1s;
  write(key, grid, all);  // told again, and nothing new
  record();
  EXPECT_TRUE(await(store->flush()));
  EXPECT_EQ(rows("shades"), 1) << "ten tiles that look alike";
  store.reset();
  open();
  now += 1s;
  record("tomorrow");
  EXPECT_TRUE(await(store->flush()));
  EXPECT_EQ(rows("shades"), 1);
  EXPECT_EQ(look_then(key, now, "tomorrow") == look_now(key), true);
}

TEST_F(PastGridsTest, WhatIsTooOldGoesAndTheRestLooksAsItDid) {
  OccupancyGrid grid(0.05);
  GridKey const key{"yard", "", "ground"};
  grid.set({300, 0}, Evidence::of_probability(0.1));  // and never again
  std::vector<std::pair<base::UtcTime, Look>> shown;
  for (int minute = 0; minute < 600; ++minute) {
    now += 1min;
    grid.set({minute % 256, minute / 256}, Evidence::of_probability(0.9));
    write(key, grid, minute == 0 ? std::vector<TileKey>{{0, 0}, {1, 0}} : std::vector<TileKey>{{0, 0}});
    record();
    shown.emplace_back(now, look_now(key));
    if (minute % 50 == 0) {
      ASSERT_TRUE(await(store->flush()));
    }
  }
  store.reset();
  auto const before = care::summary(folder.path().string())->tile_shades;
  ASSERT_TRUE(care::compact(folder.path().string(), {.longest = 5h}));
  auto const after = care::summary(folder.path().string())->tile_shades;
  EXPECT_LT(after, before * 6 / 10);
  EXPECT_GT(after, before * 4 / 10);
  open();
  for (auto const& [at, look] : shown) {
    if (at <= now - 5h + 1min) continue;
    ASSERT_EQ(look_then(key, at) == look, true) << (now - at) / 1min << " minutes ago";
  }
  store.reset();
  EXPECT_EQ(care::verify(folder.path().string())->faults, std::vector<std::string>());
}

TEST(GridList, ReadsNothingThatIsNone) {
  past::GridList const list{.key = {"yard", "0", "ground"},
                            .place = {.resolution_m = 0.05, .anchor = geo::Wgs84::from_degrees(47.0, 8.0)},
                            .is_anew = true,
                            .tiles = {{{-1, 2}, "00112233445566778899aabbccddeeff"}, {{0, 0}, ""}}};
  auto const bytes = past::packed(list);
  auto const read = past::unpacked_list(bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->key, list.key);
  EXPECT_EQ(read->tiles, list.tiles);
  EXPECT_TRUE(read->is_anew);
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(past::unpacked_list(bytes.substr(0, size)));
  EXPECT_FALSE(past::unpacked_list(bytes + '\0'));
}

}  // namespace
}  // namespace lapwing::map
