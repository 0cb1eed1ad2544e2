#pragma once

#include <optional>
#include <span>

#include "map/grid/occupancy_grid.hpp"

namespace lapwing::robot {

/// How little a scan fits the map where it is laid: of its ends that lie where the map knows something, the part that
/// lies on free floor, away from everything taken. 0: all fits. Nothing where too few of them do.
[[nodiscard]] std::optional<double> misfit(map::OccupancyGrid const& grid,
                                           std::span<geo::Point<map::GridFrame> const> ends);

/// Whether the place on the map is still known, by how the scans fit there: who takes a robot up and puts it down
/// elsewhere is felt by no wheel. People that stand about it for a moment are no reason to doubt.
class PoseCheck {
 public:
  /// True: it is lost.
  [[nodiscard]] bool feed(double time_s, std::optional<double> misfit);

 private:
  std::optional<double> otherwise_since_s_;  ///< the scans say otherwise than is believed
  bool is_lost_ = false;
};

}  // namespace lapwing::robot
