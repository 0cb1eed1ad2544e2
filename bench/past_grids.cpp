// What it costs to keep how an occupancy grid of 4,000 by 4,000 cells looked, a second of it each second, while it
// changes five times a second: bytes and processor time a minute, and how long a moment takes to come back. Prints
// JSON.
//
// usage: bench_past_grids FOLDER robot|all|none
//
// `robot`: a robot with a laser of 10 m drives through it; `all`: a hundredth of the cells of every tile changes each
// time; `none`: as `robot`, and nothing of it is kept. What is written of the map itself is in all three.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "map/store/care/care.hpp"
#include "map/store/store.hpp"

namespace lapwing::bench {
namespace {

using namespace std::chrono_literals;
using namespace lapwing::map;

constexpr std::int32_t side = 4'000;
constexpr int seconds = 120;
constexpr int scans_a_second = 5;
GridKey const key{"site", "", "ground"};

class World {
 public:
  World() {
    // Rooms of 8 m, which somebody has been through before: sure in different degrees.
    for (std::int32_t y = 0; y < side; ++y)
      for (std::int32_t x = 0; x < side; ++x) {
        bool const is_wall = x % 160 < 3 || (y % 160 < 3 && x % 160 > 30);
        grid_.set({x, y}, Evidence::of_log_odds((is_wall ? 3.0 : -3.0) + 0.25 * (random() % 8)));
      }
    for (auto const& [tile, cells] : grid_.tiles()) all_.push_back(tile);
  }
  void scan(int number) {
    double const at = number / static_cast<double>(scans_a_second) * 0.5 / 0.05;  // half a metre a second
    auto const x0 = 400.0 + at, y0 = 900.0;
    std::set<TileKey> touched;
    for (int ray = 0; ray < 720; ++ray) {
      double const angle = ray * std::numbers::pi / 360.0;
      auto const length = 60 + static_cast<int>(random() % 140);
      for (int step = 0; step <= length; ++step) {
        Cell const cell{static_cast<std::int32_t>(x0 + step * std::cos(angle)),
                        static_cast<std::int32_t>(y0 + step * std::sin(angle))};
        grid_.set(cell, Evidence::of_log_odds(
                            std::clamp(grid_.at(cell).log_odds() + (step == length ? 0.85 : -0.4), -5.0, 5.0)));
        touched.insert(tile_of(cell));
      }
    }
    changed_.assign(touched.begin(), touched.end());
  }
  void scribble() {
    for (auto const& tile : all_) {
      auto& cells = grid_.tile_to_write(tile).cells;
      for (int i = 0; i < 655; ++i) cells[random() % cells.size()] = Evidence::of_log_odds(random() % 2 ? 3.0 : -3.0);
    }
    changed_ = all_;
  }
  [[nodiscard]] OccupancyGrid const& grid() const { return grid_; }
  [[nodiscard]] std::vector<TileKey> const& changed() const { return changed_; }
  [[nodiscard]] std::vector<TileKey> const& all() const { return all_; }

 private:
  std::mt19937 random_{1};
  std::uint32_t random() { return static_cast<std::uint32_t>(random_()); }
  OccupancyGrid grid_{0.05};
  std::vector<TileKey> all_;
  std::vector<TileKey> changed_;
};

double cpu() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

int run(std::string const& folder, std::string_view kind) {
  auto const began = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  base::Loop loop({.unpaced = true, .begins_at = began});
  LiveMap map([&loop] { return loop.utc_now() + 1h; });
  map.put_site(geo::Site::make("site", geo::Wgs84::from_degrees(47.4, 8.5, 420.0)).value());
  auto store = Store::open(loop, {.address = folder}).value();
  store->follow(map);
  World world;
  auto const put = [&](std::vector<TileKey> const& tiles, base::UtcTime at) {
    if (auto done = map.put_tiles(key, world.grid(), tiles, {"robot", at}); !done) std::exit(1);
  };
  put(world.all(), began);
  bool const keeps = kind != "none";
  if (keeps) loop.run_until_done(store->record_grids("s", began));
  (void)loop.run_until_done(store->flush());
  auto const first = care::summary(folder).value();
  double keeping = 0.0, writing = 0.0;
  std::size_t tiles = 0;
  for (int second = 1; second <= seconds; ++second) {
    for (int scan = 0; scan < scans_a_second; ++scan) {
      if (kind == "all")
        world.scribble();
      else
        world.scan(second * scans_a_second + scan);
      put(world.changed(), began + 1s * second + 1ms * scan);
      tiles += world.changed().size();
    }
    auto const before = cpu();
    if (keeps) loop.run_until_done(store->record_grids("s", began + 1s * second + 500ms));
    auto const packed = cpu();
    (void)loop.run_until_done(store->flush());
    keeping += packed - before;
    writing += cpu() - packed;
  }
  auto const last = care::summary(folder).value();
  auto const asked = std::chrono::steady_clock::now();
  std::vector<std::string> names;
  if (keeps)
    for (auto const& [tile, name] :
         loop.run_until_done(store->grids_at("s", began + 1s * (seconds / 2)))->at(key).tiles)
      names.push_back(name);
  auto const listed = std::chrono::steady_clock::now();
  (void)loop.run_until_done(store->shades(names));
  auto const read = std::chrono::steady_clock::now();
  constexpr double minutes = seconds / 60.0;
  fmt::print(
      R"({{"kind":"{}","tiles_changed_a_second":{:.1f},"looks_a_minute":{:.0f},"kilobytes_a_minute":{:.0f},)"
      R"("first_kilobytes":{:.0f},"pack_cpu_s_a_minute":{:.2f},"write_cpu_s_a_minute":{:.2f},"list_ms":{:.1f},"read_ms":{:.1f},"tiles":{}}})"
      "\n",
      kind, static_cast<double>(tiles) / seconds, static_cast<double>(last.tile_shades - first.tile_shades) / minutes,
      (static_cast<double>(last.bytes) - static_cast<double>(first.bytes)) / 1000.0 / minutes,
      static_cast<double>(first.bytes) / 1000.0, keeping / minutes, writing / minutes,
      std::chrono::duration<double, std::milli>(listed - asked).count(),
      std::chrono::duration<double, std::milli>(read - listed).count(), names.size());
  return 0;
}

}  // namespace
}  // namespace lapwing::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: bench_past_grids FOLDER robot|all|none\n", stderr);
    return 2;
  }
  return lapwing::bench::run(argv[1], argv[2]);
}
