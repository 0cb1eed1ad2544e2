#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "dryrun/internal/canvas.hpp"

namespace lapwing::dryrun::internal {

/// Finds room for texts on a map, first come first served.
class Labels {
 public:
  explicit Labels(Box const& area) : area_(area) {}

  /// Keeps others away from there.
  void occupy(Box const& box) { taken_.push_back(box); }
  /// Where the base line of a text beside `anchor` begins; nothing when there is no room on any side of it.
  [[nodiscard]] std::optional<Point> place(Point anchor, std::string_view text, double size, double gap);

 private:
  Box area_;
  std::vector<Box> taken_;
};

}  // namespace lapwing::dryrun::internal
