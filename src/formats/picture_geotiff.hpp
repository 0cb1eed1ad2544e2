#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "map/features/contents.hpp"

namespace lapwing::formats {

/// Draws a picture onto the ground that it shows, by the perspective that takes its corners to those of the footprint
/// (exact for level ground and a lens without distortion), as a cloud optimized GeoTIFF in the plane of its site, with
/// the pixels' mean size on the ground. `bytes`: the image file. Precondition: the footprint has four corners. Errors,
/// invalid_input: bytes that are no picture, or more than 400 million pixels; io.
[[nodiscard]] base::Result<> write_picture_geotiff(map::Picture const& picture, std::string const& bytes,
                                                   geo::Site const& site, std::filesystem::path const& path);

}  // namespace lapwing::formats
