// The live map: putting features, finding them by viewport, and drawing a grid of 4,000 by 4,000 cells, of which a
// robot changes a few tiles five times a second while viewers look at it.
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "map/features/feature_json.hpp"
#include "map/features/placement.hpp"
#include "map/grid/grid_tiles.hpp"
#include "map/grid/png.hpp"
#include "map/live/live_map.hpp"

namespace {

using namespace lapwing;
using namespace lapwing::map;

constexpr int features = 100'000;
constexpr auto now = base::UtcTime(std::chrono::seconds(1'795'255'972));

geo::Site const& site() {
  static auto const site = *geo::Site::make("yard", geo::Wgs84::from_degrees(41.15, -8.61, 90.0));
  return site;
}

/// Slots all over a kilometre.
std::vector<Feature> slots(int seconds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-500.0, 500.0);
  std::vector<Feature> slots;
  for (int i = 0; i < features; ++i) {
    double const x = any(random);
    double const y = any(random);
    slots.push_back({.id = fmt::format("slot {}", i),
                     .site = "yard",
                     .account = {"drone 1", now + std::chrono::seconds(seconds)},
                     .content = Slot{.outline = {{{{x, y}, {x + 2.5, y}, {x + 2.5, y + 5.0}, {x, y + 5.0}}}},
                                     .state = SlotState::taken,
                                     .taken_probability = 0.9}});
  }
  return slots;
}

void put_one_by_one(benchmark::State& state) {
  int seconds = 0;
  LiveMap map([&] { return now + std::chrono::hours(1'000); });
  map.put_site(site());
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    auto given = slots(seconds++);
    state.ResumeTiming();
    for (auto& slot : given) benchmark::DoNotOptimize(map.put(std::move(slot)));
  }
  state.SetItemsProcessed(state.iterations() * features);
}

void put_all_at_once(benchmark::State& state) {
  int seconds = 0;
  LiveMap map([&] { return now + std::chrono::hours(1'000); });
  map.put_site(site());
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    auto given = slots(seconds++);
    state.ResumeTiming();
    benchmark::DoNotOptimize(map.put_all(std::move(given)));
  }
  state.SetItemsProcessed(state.iterations() * features);
}

void find_in_view(benchmark::State& state) {
  LiveMap map([] { return now; });
  map.put_site(site());
  (void)map.put_all(slots(0));
  double const half_m = static_cast<double>(state.range(0)) / 2.0;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-450.0, 450.0);
  std::size_t found = 0;
  for ([[maybe_unused]] auto _ : state) {
    SitePoint const middle(any(random), any(random));
    geo::Vector<geo::SiteFrame> const half(half_m, half_m);
    found += map.within(LayerKind::slots, "yard", SiteBox{middle - half, middle + half}, features).size();
  }
  state.counters["found"] = static_cast<double>(found) / static_cast<double>(state.iterations());
}

void write_json(benchmark::State& state) {
  auto const given = slots(0);
  std::size_t i = 0;
  std::size_t bytes = 0;
  for ([[maybe_unused]] auto _ : state) bytes += feature_json(given[i++ % given.size()], site()).dump().size();
  state.counters["bytes"] = static_cast<double>(bytes) / static_cast<double>(state.iterations());
}

/// Rooms of 8 m with walls and some noise, turned a little: 200 m a side.
OccupancyGrid const& hall() {
  static auto const grid = [] {
    OccupancyGrid made(0.05, {{10.0, 20.0}, 0.3});
    std::mt19937 random(3);
    for (int x = -2'000; x < 2'000; ++x) {
      for (int y = -2'000; y < 2'000; ++y) {
        bool const is_wall = x % 160 == 0 || y % 160 == 0 || random() % 500 == 0;
        made.tile_to_write(tile_of({x, y}))
            .cells[static_cast<std::size_t>(y & 255) * 256 + static_cast<std::size_t>(x & 255)] =
            Evidence::of_log_odds(is_wall ? 3.0 : -2.0 - static_cast<double>(random() % 100) / 50.0);
      }
    }
    return made;
  }();
  return grid;
}

XyzTile tile_at(int zoom) {
  auto const place = place_of(site(), {40.0, 40.0});
  double const across = std::ldexp(1.0, zoom);
  return {zoom, static_cast<std::int64_t>((place.lon_rad / std::numbers::pi + 1.0) / 2.0 * across),
          static_cast<std::int64_t>((1.0 - std::asinh(std::tan(place.lat_rad)) / std::numbers::pi) / 2.0 * across)};
}

void prepare_whole_grid(benchmark::State& state) {
  auto const& grid = hall();
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(GridPyramid(grid));
  state.counters["tiles"] = static_cast<double>(grid.tiles().size());
}

/// What a robot in the middle of a tile's corner changes at each scan.
void prepare_four_changed_tiles(benchmark::State& state) {
  auto grid = hall();
  GridPyramid pyramid(grid);
  int steps = 0;
  for ([[maybe_unused]] auto _ : state) {
    for (auto const key : {TileKey{0, 0}, TileKey{0, 1}, TileKey{1, 0}, TileKey{1, 1}})
      grid.tile_to_write(key).cells[5] = Evidence::of_steps(++steps % 1'000);
    pyramid = GridPyramid(grid, pyramid);
  }
}

void draw_tile(benchmark::State& state) {
  GridPyramid const pyramid(hall());
  auto const tile = tile_at(static_cast<int>(state.range(0)));
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(render(pyramid, site(), tile));
}

void pack_tile(benchmark::State& state) {
  auto const shades = render(GridPyramid(hall()), site(), tile_at(static_cast<int>(state.range(0))));
  std::size_t bytes = 0;
  for ([[maybe_unused]] auto _ : state) bytes = png_of(*shades, tile_px, scale_palette()).size();
  state.counters["bytes"] = static_cast<double>(bytes);
}

BENCHMARK(put_one_by_one)->Name("features/put_one_by_one")->Unit(benchmark::kMillisecond);
BENCHMARK(put_all_at_once)->Name("features/put_all_at_once")->Unit(benchmark::kMillisecond);
BENCHMARK(find_in_view)->Name("features/find_in_view_m")->Arg(20)->Arg(100)->Arg(500)->Unit(benchmark::kMicrosecond);
BENCHMARK(write_json)->Name("features/write_json")->Unit(benchmark::kMicrosecond);
BENCHMARK(prepare_whole_grid)->Name("grid/prepare_whole")->Unit(benchmark::kMillisecond);
BENCHMARK(prepare_four_changed_tiles)->Name("grid/prepare_four_changed_tiles")->Unit(benchmark::kMillisecond);
BENCHMARK(draw_tile)
    ->Name("grid/draw_tile_at_zoom")
    ->Arg(14)
    ->Arg(17)
    ->Arg(19)
    ->Arg(21)
    ->Arg(23)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(pack_tile)->Name("grid/pack_tile_at_zoom")->Arg(17)->Arg(19)->Arg(21)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
