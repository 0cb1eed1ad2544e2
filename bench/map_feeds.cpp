// What the map costs a station that shows it. `slots_changing`: 2,000 parking slots, each changing ten times a second,
// for so many viewers, one round of the station's five a second; `newcomer`: 100,000 slots for one who comes;
// `pictures`: tiles of a grid of 4,000 by 4,000 cells, one after the other, and `pictures_of_what_changes`: the first
// of them after every cell has changed.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>

#include "base/async/loop.hpp"
#include "station/map/features/feature_feed.hpp"
#include "station/map/grids/grid_pictures.hpp"
#include "station/testing/map_demo.hpp"

namespace {

using namespace std::chrono_literals;
using namespace lapwing;

constexpr std::size_t room = std::size_t{64} * 1024;

/// Three hundred slots a row.
double row(int slot) {
  return std::floor(slot / 300.0);
}

struct Slots : station::testing::MapDemo {
  explicit Slots(int count) {
    std::vector<map::Feature> all;
    for (int i = 0; i < count; ++i)
      all.push_back(station::testing::slot(fmt::format("{}", i), 3.0 * (i % 300), 6.0 * row(i), at));
    if (!live.put_all(std::move(all))) std::abort();
  }
  void change(int i) {
    auto const state = turn++ % 2 == 0 ? map::SlotState::taken : map::SlotState::free;
    at += 1us;
    put(station::testing::slot(fmt::format("{}", i), 3.0 * (i % 300), 6.0 * row(i), at, state));
  }
  /// All that leads a viewer to the present, in the pieces in which it goes out; how many bytes that were.
  std::size_t catch_up(std::uint64_t& revision) {
    std::size_t bytes = 0;
    for (auto const newest = feed.refresh({}); revision != newest;) {
      auto const news = feed.since(revision, {}, room);
      for (auto const& frame : news.frames) bytes += frame.content.size();
      revision = news.frames.empty() ? newest : news.frames.back().revision;
    }
    return bytes;
  }

  base::UtcTime at = now() - 1h;
  int turn = 0;
  station::FeatureFeed feed{live, map::LayerKind::slots};
};

void slots_changing(benchmark::State& state) {
  constexpr int count = 2'000;
  Slots slots(count);
  std::vector<std::uint64_t> viewers(static_cast<std::size_t>(state.range(0)));
  for (auto& viewer : viewers) (void)slots.catch_up(viewer);
  std::size_t bytes = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    for (int change = 0; change < 2; ++change)
      for (int i = 0; i < count; ++i) slots.change(i);
    state.ResumeTiming();
    for (auto& viewer : viewers) bytes += slots.catch_up(viewer);
  }
  constexpr double rounds_a_second = 5.0;
  state.counters["kB_a_viewer_and_s"] = static_cast<double>(bytes) / 1e3 * rounds_a_second /
                                        static_cast<double>(viewers.size()) / static_cast<double>(state.iterations());
}
BENCHMARK(slots_changing)->Arg(1)->Arg(20)->Unit(benchmark::kMillisecond);

void writing(benchmark::State& state) {
  Slots slots(2'000);
  int i = 0;
  for ([[maybe_unused]] auto _ : state) slots.change(i++ % 2'000);
}
BENCHMARK(writing)->Unit(benchmark::kMicrosecond);

void newcomer(benchmark::State& state) {
  Slots slots(100'000);
  for ([[maybe_unused]] auto _ : state) {
    std::uint64_t revision = 0;
    benchmark::DoNotOptimize(slots.catch_up(revision));
  }
}
BENCHMARK(newcomer)->Unit(benchmark::kMillisecond);

struct Grid : station::testing::MapDemo {
  static constexpr int side = 4'000;

  void put_all() {
    at += 1ms;
    map::OccupancyGrid grid(0.05);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        auto const noise = static_cast<unsigned>(x * 7919 + y * 104'729 + turn) % 97;
        grid.set({x, y}, map::Evidence::of_probability(x % 400 < 6 || y % 300 < 6 ? 0.97 : 0.02 + 0.001 * noise));
      }
    ++turn;
    std::vector<map::TileKey> tiles;
    for (auto const& [at_tile, cells] : grid.tiles()) tiles.push_back(at_tile);
    if (!live.put_tiles(key, grid, tiles, {"robot 1", at})) std::abort();
  }
  base::Task<> fetch(map::XyzTile tile) { (void)co_await pictures.picture(key, tile); }
  /// Which has the middle of the grid in it.
  static map::XyzTile middle(int zoom) {
    return station::tile_at(zoom, 8.0 + 100.0 / 76'057.0, 47.0 + 100.0 / 111'170.0);
  }

  map::GridKey key{"yard", "0", "floor"};
  base::UtcTime at = now() - 1h;
  int turn = 0;
  // Nothing is kept, so that each is drawn.
  station::GridPictures pictures{
      loop, live, std::make_shared<station::GridPlaces>(live), {.most_bytes = 0, .most_jobs = 2}};
};

void pictures(benchmark::State& state) {
  Grid grid;
  grid.put_all();
  auto const tile = Grid::middle(static_cast<int>(state.range(0)));
  auto const beside = map::XyzTile{tile.zoom, tile.x + 1, tile.y};
  grid.loop.run_until_done(grid.fetch(tile));
  bool is_first = false;
  for ([[maybe_unused]] auto _ : state)
    grid.loop.run_until_done(grid.fetch(std::exchange(is_first, !is_first) ? tile : beside));
}
BENCHMARK(pictures)->Arg(15)->Arg(18)->Arg(20)->Arg(22)->Unit(benchmark::kMillisecond)->UseRealTime();

void pictures_of_what_changes(benchmark::State& state) {
  Grid grid;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    grid.put_all();
    state.ResumeTiming();
    grid.loop.run_until_done(grid.fetch(Grid::middle(18)));
  }
}
BENCHMARK(pictures_of_what_changes)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
