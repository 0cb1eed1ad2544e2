#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "map/live/live_map.hpp"
#include "map/store/sql/database.hpp"

namespace lapwing::map::rows {

/// A tile, and when it was so; null: nothing is known there any more.
struct KeptTile {
  std::shared_ptr<GridTile const> tile = {};
  base::UtcTime at = {};
};
using KeptTiles = std::map<TileKey, KeptTile>;

/// A grid with some of its tiles.
struct GridPart {
  double resolution_m = 0.0;
  geo::Transform<geo::SiteFrame, GridFrame> site_from_grid = {};
  Account account = {};
  KeptTiles tiles = {};
};

/// Tiles are put over the old ones; all of these go when the grid has another place or resolution.
[[nodiscard]] base::Result<> write_grid(sql::Database& database, GridKey const& key, GridPart const& part,
                                        Revision revision);
/// Those that have changed since, without tiles.
[[nodiscard]] base::Result<std::map<GridKey, GridPart>> read_grids(sql::Database& database, Revision since = 0);
/// Those that have changed since. Error, io: cells that are none.
[[nodiscard]] base::Result<KeptTiles> read_tiles(sql::Database& database, GridKey const& key, Revision since = 0);

/// As they lie in the column `cells`.
[[nodiscard]] std::string packed(GridTile const& tile);
[[nodiscard]] std::shared_ptr<GridTile const> unpacked(std::string_view cells);

}  // namespace lapwing::map::rows
