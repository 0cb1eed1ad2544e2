#include "map/grid/ros_map.hpp"

#include <cmath>

#include <fmt/format.h>

namespace lapwing::map {

namespace {

constexpr char taken = 0;
constexpr char free_space = static_cast<char>(254);
constexpr char unknown = static_cast<char>(205);
/// By which a reader tells 205, which is 0.1961 of the way to black, from 254: with a greater number, such as the 0.25
/// that Nav2 assumes where a file says nothing, everything unknown would be free.
constexpr double free_threshold = 0.196;

char pixel_of(Evidence evidence, RosMapOptions const& options) {
  if (options.is_raw) return static_cast<char>(evidence.is_seen() ? std::lround(evidence.probability() * 100.0) : 255);
  if (!evidence.is_seen()) return unknown;
  auto const probability = evidence.probability();
  if (probability > options.taken_above) return taken;
  return probability < options.free_below ? free_space : unknown;
}

std::string pgm_of(OccupancyGrid const& grid, CellBox const& box, RosMapOptions const& options) {
  auto pgm =
      fmt::format("P5\n# {} m a cell, written by lapwing\n{} {}\n255\n", grid.resolution_m(), box.width, box.height);
  pgm.reserve(pgm.size() + static_cast<std::size_t>(box.width * box.height));
  for (std::int64_t y = box.height - 1; y >= 0; --y) {
    for (std::int64_t x = 0; x < box.width; ++x) {
      Cell const cell{static_cast<std::int32_t>(box.least.x + x), static_cast<std::int32_t>(box.least.y + y)};
      pgm += pixel_of(grid.at(cell), options);
    }
  }
  return pgm;
}

}  // namespace

RosMap ros_map(OccupancyGrid const& grid, CellBox const& box, std::string_view name, RosMapOptions const& options) {
  auto const corner = grid.site_from_grid() *
                      geo::Point<GridFrame>(box.least.x * grid.resolution_m(), box.least.y * grid.resolution_m());
  return {.pgm = pgm_of(grid, box, options),
          .yaml = fmt::format("image: {}.pgm\nmode: {}\nresolution: {}\norigin: [{:.10g}, {:.10g}, {:.10g}]\nnegate: "
                              "0\noccupied_thresh: {}\nfree_thresh: {}\n",
                              name, options.is_raw ? "raw" : "trinary", grid.resolution_m(), corner.x(), corner.y(),
                              grid.site_from_grid().yaw_rad(), options.taken_above, free_threshold)};
}

}  // namespace lapwing::map
