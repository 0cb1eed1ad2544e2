#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/frames/records.hpp"

namespace lapwing::robot {

/// A whole scan of the board's laser, in the laser's own directions.
struct LaserRanges {
  firmware::Time time{};  ///< of the first beam
  double first_angle_rad = 0;
  double step_rad = 0;
  std::vector<double> ranges_m;  ///< zero: nothing was seen
};

/// Pieces into scans. A scan of which a piece was lost is none: a gap in a wall is worth less than no scan.
class ScanAssembly {
 public:
  /// The scan that this piece completed.
  [[nodiscard]] std::optional<LaserRanges> feed(firmware::LaserPiece const& piece);
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  LaserRanges scan_;
  std::size_t beams_ = 0;
  bool is_open_ = false;
  std::uint64_t lost_ = 0;
};

}  // namespace lapwing::robot
