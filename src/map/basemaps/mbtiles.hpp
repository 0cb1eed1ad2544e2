#pragma once

#include <filesystem>
#include <memory>

#include "base/error.hpp"
#include "map/basemaps/tile_archive.hpp"

namespace lapwing::map {

/// MBTiles 1.3 (github.com/mapbox/mbtiles-spec): a SQLite file with tables or views `tiles` and `metadata`, rows
/// counted from the south. Errors: io; invalid_input for a file without these tables.
[[nodiscard]] base::Result<std::shared_ptr<TileArchive const>> open_mbtiles(std::filesystem::path const& path);

}  // namespace lapwing::map
