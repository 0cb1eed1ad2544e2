#pragma once

#include <string>
#include <vector>

#include "station/testing/map_demo.hpp"

namespace lapwing::station::testing {

inline map::GridKey const floor_grid{"yard", "0", "floor"};

/// A grid of 0.5 m a cell, so of 128 m a tile, with one cell taken in the middle of each of these tiles.
inline map::OccupancyGrid grid_with(std::vector<map::TileKey> const& tiles, double resolution_m = 0.5) {
  map::OccupancyGrid grid(resolution_m);
  for (auto const& tile : tiles)
    grid.set({tile.x * map::tile_cells + 128, tile.y * map::tile_cells + 128}, map::Evidence::of_probability(0.95));
  return grid;
}

inline void put_tiles(MapDemo& demo, std::vector<map::TileKey> const& tiles, base::UtcTime at,
                      map::GridKey const& key = floor_grid, double resolution_m = 0.5) {
  auto const done = demo.live.put_tiles(key, grid_with(tiles, resolution_m), tiles, {"robot 1", at});
  if (!done) throw std::runtime_error(done.error().message);
}

}  // namespace lapwing::station::testing
