#include "apps/slam/map_files.hpp"

#include <algorithm>
#include <vector>

#include "base/assert.hpp"
#include "base/files/replace_file.hpp"
#include "map/grid/cell_box.hpp"
#include "map/grid/png.hpp"
#include "map/grid/ros_map.hpp"

namespace lapwing::apps {
namespace {

/// In the middle of a square picture, as the map room packs them.
std::string png_of(map::OccupancyGrid const& grid, map::CellBox const& box) {
  auto const side = std::max(box.width, box.height);
  auto const left = (side - box.width) / 2;
  auto const top = (side - box.height) / 2;
  std::vector<map::Shade> shades(static_cast<std::size_t>(side * side), 0);
  for (std::int64_t y = 0; y < box.height; ++y) {
    for (std::int64_t x = 0; x < box.width; ++x) {
      map::Cell const cell{static_cast<std::int32_t>(box.least.x + x),
                           static_cast<std::int32_t>(box.least.y + box.height - 1 - y)};
      shades[static_cast<std::size_t>((y + top) * side + x + left)] = map::shade_of(grid.at(cell));
    }
  }
  return map::png_of(shades, static_cast<int>(side), map::trinary_palette());
}

}  // namespace

base::Result<> write_map(map::OccupancyGrid const& grid, std::filesystem::path const& folder) {
  auto const box = map::seen_box(grid);
  LAPWING_ASSERT(box.has_value());
  auto const map = map::ros_map(grid, *box, "map");
  if (auto done = base::replace_file(folder / "map.pgm", map.pgm); !done) return done;
  if (auto done = base::replace_file(folder / "map.yaml", map.yaml); !done) return done;
  return base::replace_file(folder / "map.png", png_of(grid, *box));
}

}  // namespace lapwing::apps
