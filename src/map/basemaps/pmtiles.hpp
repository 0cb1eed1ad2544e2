#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "map/basemaps/tile_archive.hpp"

namespace lapwing::map {

/// So many bytes from so far into the archive; fewer, or nothing, where it ends before. Called on any thread.
using ReadBytes = std::function<std::string(std::uint64_t offset, std::size_t length)>;

/// PMTiles version 3 (github.com/protomaps/PMTiles, spec/v3): a header, directories of which large ones are in leaves,
/// and tiles, all found by offset. Errors: invalid_input.
[[nodiscard]] base::Result<std::shared_ptr<TileArchive const>> open_pmtiles(ReadBytes read);

/// Where a tile stands in the order of PMTiles: by zoom, then along a Hilbert curve. Precondition: valid.
[[nodiscard]] std::uint64_t pmtiles_id(TileAddress const& address);

}  // namespace lapwing::map
