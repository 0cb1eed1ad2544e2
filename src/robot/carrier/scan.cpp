#include "robot/carrier/scan.hpp"

#include <utility>

namespace lapwing::robot {

std::optional<LaserRanges> ScanAssembly::feed(firmware::LaserPiece const& piece) {
  bool const goes_on =
      is_open_ && piece.time == scan_.time && piece.begin == scan_.ranges_m.size() && piece.beams == beams_;
  if (!goes_on) {
    if (is_open_) ++lost_;
    is_open_ = piece.begin == 0;
    if (!is_open_) return std::nullopt;
    scan_ = {.time = piece.time,
             .first_angle_rad = static_cast<double>(piece.first_angle_rad),
             .step_rad = static_cast<double>(piece.step_rad),
             .ranges_m = {}};
    beams_ = piece.beams;
  }
  for (auto const range_mm : piece.ranges()) scan_.ranges_m.push_back(range_mm * 1e-3);
  if (scan_.ranges_m.size() < beams_) return std::nullopt;
  is_open_ = false;
  return std::exchange(scan_, {});
}

}  // namespace lapwing::robot
