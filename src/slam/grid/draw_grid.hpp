#pragma once

#include "map/grid/occupancy_grid.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

/// What one beam says of the cells that it crosses.
struct BeamModel {
  double cell_m = 0.05;
  double most_range_m = 20.0;    ///< beyond, a degree is wider than a door post
  double taken_log_odds = 0.85;  ///< of the cell that it ends in
  double free_log_odds = -0.4;   ///< of those before, while it is narrower than a cell
  double noise_m = 0.02;         ///< of a range; what it adds is spread over the cells so far around the end
  double noise_per_m = 0.004;
  double width_rad = 0.0087;
};

/// Draws the scans from where they were taken, as log-odds (Moravec & Elfes 1985; Thrun, Burgard & Fox 2005,
/// table 9.1). What lies between two beams of a scanner is a little likelier to be free than not, up to the nearer of
/// their ends; so are beams from which nothing came back, between two that come nearly as far as the sensor sees. Where
/// a building is so large that its picture had more than a hundred million cells, cells are made larger. Precondition:
/// as many poses as scans.
[[nodiscard]] map::OccupancyGrid draw_grid(ScanLog const& log, std::vector<Pose2> const& poses, BeamModel const& model);

}  // namespace lapwing::slam
