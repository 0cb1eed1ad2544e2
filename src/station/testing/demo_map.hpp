#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/assert.hpp"
#include "map/live/live_map.hpp"

/// A map with something in each layer, for tests of the browser app and of programs that read it: a car park, and an
/// office of two floors beside it.
namespace lapwing::station::testing {

class DemoMap {
 public:
  /// Its site is called "demo" and has its anchor there.
  DemoMap(map::LiveMap& map, geo::Wgs84 anchor, base::UtcTime at) : map_(map), at_(at) {
    map_.put_site(
        geo::Site::make("demo", anchor,
                        {{.id = "0", .name = "Ground floor"}, {.id = "1", .name = "First floor", .up_m = 3.5}})
            .value());
    put_slots();
    put_office();
    put_area();
    put_grid();
  }

 private:
  void put(std::string id, std::string floor, map::Content content) {
    auto const done = map_.put({.id = std::move(id),
                                .site = "demo",
                                .floor = std::move(floor),
                                .account = {.writer = "drone 1", .at = at_},
                                .content = std::move(content)});
    LAPWING_ASSERT(done.has_value());
  }

  /// Four rows of fifteen, a third of them taken.
  void put_slots() {
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 15; ++column) {
        double const x = 20.0 + 2.5 * column;
        double const y = -40.0 + 11.0 * row;
        bool const is_taken = (row + column) % 3 == 0;
        put(fmt::format("P{}{:02}", row + 1, column + 1), "",
            map::Slot{.outline = {{{{x, y}, {x + 2.5, y}, {x + 2.5, y + 5.0}, {x, y + 5.0}}}},
                      .state = is_taken ? map::SlotState::taken : map::SlotState::free,
                      .taken_probability = is_taken ? 0.93 : 0.04,
                      .seen_at = at_,
                      .seen_by = "1",
                      .name = fmt::format("{}{:02}", row + 1, column + 1)});
      }
    }
  }

  void put_office() {
    put("outer wall", "1",
        map::Wall{.line = {{{-30, 0}, {-10, 0}, {-10, 12}, {-30, 12}, {-30, 0}}}, .thickness_m = 0.3});
    put("corridor", "1", map::Wall{.line = {{{-30, 7}, {-12, 7}}}, .thickness_m = 0.1});
    for (int i = 0; i < 5; ++i)
      put(fmt::format("door {}", 221 + i), "1",
          map::PointOfInterest{.position = {-28.0 + 4.0 * i, 7.0},
                               .kind = "door",
                               .name = fmt::format("{}", 221 + i),
                               .text = fmt::format("Room {}", 221 + i),
                               .facing_rad = -1.5707963,
                               .confidence = 0.9});
  }

  void put_area() {
    put("lawn", "",
        map::Area{.outline = {{{{-60, -60}, {-35, -60}, {-35, -30}, {-60, -30}}}},
                  .purpose = map::AreaPurpose::no_go,
                  .name = "Lawn"});
  }

  /// The office floor as a robot sees it.
  void put_grid() {
    map::OccupancyGrid grid(0.1);
    for (int x = -300; x <= -100; ++x)
      for (int y = 0; y <= 120; ++y) {
        bool const is_wall = x == -300 || x == -100 || y == 0 || y == 120 || (y == 70 && x < -120);
        grid.set({x, y}, map::Evidence::of_probability(is_wall ? 0.97 : 0.05));
      }
    std::vector<map::TileKey> tiles;
    for (auto const& [key, tile] : grid.tiles()) tiles.push_back(key);
    auto const done = map_.put_tiles({"demo", "1", "floor"}, grid, tiles, {"robot 1", at_});
    LAPWING_ASSERT(done.has_value());
  }

  map::LiveMap& map_;
  base::UtcTime at_;
};

}  // namespace lapwing::station::testing
