#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "formats/map_contents.hpp"

namespace lapwing::formats {

struct PrintOptions {
  std::string site = {};
  std::string floor = {};  ///< only what lies on it; empty: what names no floor, and where the site has but one, all
  double scale = 100.0;    ///< 1 : scale; 100: a centimetre on paper is a metre
};

/// One floor drawn to scale as SVG or PDF, by the file's extension: grid, walls, areas, slots by state, tracks, points
/// of interest with their names, a scale bar, and marks every metre along the lower and left edges, whose corner is the
/// plan's lower left one. What is drawn has its real size on paper printed at 100 %. Errors: not_found for a site or
/// floor that is not there; invalid_input for nothing to draw, or a plan larger than the 5 m that PDF pages can have.
[[nodiscard]] base::Result<> write_print(MapContents const& contents, PrintOptions const& options,
                                         std::filesystem::path const& path);

}  // namespace lapwing::formats
