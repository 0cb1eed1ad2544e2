#pragma once

#include <vector>

#include "geo/point.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::slam {

/// One straight surface of a wall: a wall that was seen from both sides is two of them, a wall's thickness apart.
struct WallLine {
  geo::Point<map::GridFrame> from;
  geo::Point<map::GridFrame> to;
  double spread_m = 0.0;  ///< how far the cells lie beside the line, root mean square
  [[nodiscard]] double length_m() const { return geo::distance_m(from, to); }
};

struct WallOptions {
  double taken_from = 0.65;   ///< probability from which a cell counts
  double least_m = 0.4;       ///< shorter ones are furniture and feet
  double most_gap_m = 0.25;   ///< pieces on one line with no more between them are one
  double beside_m = 0.09;     ///< a cell may lie so far beside the line
  double around_m = 0.2;      ///< within which a cell's direction is looked for
  double open_m = 0.15;       ///< within which a surface has free ground before it
  double most_turn = 0.26;    ///< radians between a cell's direction and the line's
  double least_filled = 0.6;  ///< of the line's length, the share that has cells beside it
};

/// The straight walls of an occupancy grid, the longest first. Regions of cells whose surroundings lie along one
/// direction grow from the straightest (Grompone von Gioi et al. 2010, LSD, section 2.2, with the principal axis of the
/// taken cells around instead of a picture's gradient) and have free ground on one side; each gets the line with the
/// least squared distances, and those that continue each other become one. Cells that lie along nothing, such as crowds
/// of chair legs, are no wall, nor are those that have nothing free before them: what far beams met behind a wall's
/// face, or what a thick wall has between its two.
[[nodiscard]] std::vector<WallLine> find_walls(map::OccupancyGrid const& grid, WallOptions const& options = {});

}  // namespace lapwing::slam
