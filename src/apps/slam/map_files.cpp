#include "apps/slam/map_files.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/assert.hpp"
#include "base/files/replace_file.hpp"
#include "map/grid/png.hpp"

namespace lapwing::apps {
namespace {

constexpr double taken_from = 0.65;
constexpr double free_below = 0.25;
constexpr char taken = 0;
constexpr char free_space = static_cast<char>(254);
constexpr char unknown = static_cast<char>(205);

char grey_of(map::Evidence evidence) {
  if (!evidence.is_seen()) return unknown;
  auto const probability = evidence.probability();
  if (probability > taken_from) return taken;
  return probability < free_below ? free_space : unknown;
}

template <class Visit>
void for_each_seen(map::OccupancyGrid const& grid, Visit visit) {
  for (auto const& [key, tile] : grid.tiles())
    for (int y = 0; y < map::tile_cells; ++y)
      for (int x = 0; x < map::tile_cells; ++x)
        if (auto const evidence =
                tile->cells[static_cast<std::size_t>(y) * map::tile_cells + static_cast<std::size_t>(x)];
            evidence.is_seen())
          visit(key.x * map::tile_cells + x, key.y * map::tile_cells + y, evidence);
}

std::string yaml_of(GridPicture const& picture) {
  return fmt::format(
      "image: map.pgm\nmode: trinary\nresolution: {}\norigin: [{}, {}, 0.0]\nnegate: 0\noccupied_thresh: "
      "{}\nfree_thresh: {}\n",
      picture.cell_m, picture.left_m, picture.bottom_m, taken_from, free_below);
}

/// The picture in the middle of a square one, as the map room packs them.
std::string png_of(GridPicture const& picture) {
  auto const side = std::max(picture.width, picture.height);
  auto const left = (side - picture.width) / 2;
  auto const top = (side - picture.height) / 2;
  std::vector<map::Shade> shades(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 0);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      auto const grey = picture.grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                     static_cast<std::size_t>(x)];
      auto& shade = shades[static_cast<std::size_t>(y + top) * static_cast<std::size_t>(side) +
                           static_cast<std::size_t>(x + left)];
      if (grey == taken) shade = 255;
      if (grey == free_space) shade = 127;
    }
  }
  return map::png_of(shades, side, map::trinary_palette());
}

}  // namespace

GridPicture picture_of(map::OccupancyGrid const& grid) {
  auto left = std::numeric_limits<int>::max();
  auto bottom = left;
  auto right = std::numeric_limits<int>::min();
  auto top = right;
  for_each_seen(grid, [&](int x, int y, map::Evidence) {
    left = std::min(left, x);
    right = std::max(right, x);
    bottom = std::min(bottom, y);
    top = std::max(top, y);
  });
  LAPWING_ASSERT(left <= right);
  GridPicture picture{.width = right - left + 1,
                      .height = top - bottom + 1,
                      .cell_m = grid.resolution_m(),
                      .left_m = left * grid.resolution_m(),
                      .bottom_m = bottom * grid.resolution_m()};
  picture.grey.assign(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), unknown);
  for_each_seen(grid, [&](int x, int y, map::Evidence evidence) {
    picture.grey[static_cast<std::size_t>(top - y) * static_cast<std::size_t>(picture.width) +
                 static_cast<std::size_t>(x - left)] = grey_of(evidence);
  });
  return picture;
}

base::Result<> write_map(GridPicture const& picture, std::filesystem::path const& folder) {
  auto const pgm = fmt::format("P5\n{} {}\n255\n", picture.width, picture.height) + picture.grey;
  if (auto done = base::replace_file(folder / "map.pgm", pgm); !done) return done;
  if (auto done = base::replace_file(folder / "map.yaml", yaml_of(picture)); !done) return done;
  return base::replace_file(folder / "map.png", png_of(picture));
}

}  // namespace lapwing::apps
