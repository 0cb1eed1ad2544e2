#pragma once

#include <cstdint>
#include <vector>

#include "slam/walls/wall_lines.hpp"

namespace lapwing::robot {

/// Keeps walls apart while the map grows: a wall that is found again, longer or a little elsewhere, has the number that
/// it had, so that who shows walls is told of what has changed alone.
class WallBook {
 public:
  struct Entry {
    std::uint32_t number = 0;  ///< never given twice
    slam::WallLine line = {};
  };
  struct Changes {
    std::vector<Entry> put = {};  ///< new, or moved by more than two centimetres
    std::vector<std::uint32_t> removed = {};
  };

  /// All walls as they are now found.
  [[nodiscard]] Changes take(std::vector<slam::WallLine> const& found);
  [[nodiscard]] std::vector<Entry> const& walls() const { return walls_; }

 private:
  std::vector<Entry> walls_;
  std::uint32_t last_ = 0;
};

}  // namespace lapwing::robot
