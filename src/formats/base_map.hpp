#pragma once

#include <filesystem>
#include <functional>

#include "base/error.hpp"

namespace lapwing::formats {

/// How much is done, 0 to 1; false stops the work.
using Progress = std::function<bool(double)>;

/// Makes map tiles of a picture that knows where it lies (GeoTIFF in any coordinate system, JPEG 2000, JPEG or PNG with
/// a world file): an MBTiles archive in web Mercator, from the zoom at which its pixels are told apart up to where all
/// of it is one tile. An existing file is replaced once the new one is whole. Errors: invalid_input for a picture
/// without a place; io; cancelled.
[[nodiscard]] base::Result<> write_base_map(std::filesystem::path const& picture, std::filesystem::path const& archive,
                                            Progress const& progress = {});

}  // namespace lapwing::formats
