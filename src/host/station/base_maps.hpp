#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/error.hpp"
#include "station/basemaps/base_map.hpp"

namespace lapwing::host {

/// What browsers let this program's pages load tiles from. Error: invalid_input.
[[nodiscard]] base::Result<> check_tiles(std::string const& address);

/// From an address that passed `check_tiles`.
[[nodiscard]] station::BaseMap remote_base_map(std::string const& address);
/// An archive of tiles (MBTiles, PMTiles) or drawn ground (GeoJSON), by what it is; named after the file. Errors: those
/// of `map::TileArchive::open`; a GeoTIFF is told how to become an archive.
[[nodiscard]] base::Result<station::BaseMap> base_map_of(std::filesystem::path const& file);

/// Reads each `[[map.base]]`: `file` (beside the configuration) or `tiles`, and `name`, `attribution`, `max_zoom`.
/// Reports what is wrong, and leaves it out.
[[nodiscard]] std::vector<station::BaseMap> read_base_maps(base::ConfigReader& map,
                                                           std::filesystem::path const& beside);

}  // namespace lapwing::host
