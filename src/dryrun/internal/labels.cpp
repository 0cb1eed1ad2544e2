#include "dryrun/internal/labels.hpp"

#include <algorithm>
#include <array>

namespace lapwing::dryrun::internal {

std::optional<Point> Labels::place(Point anchor, std::string_view text, double size, double gap) {
  double const width = text_width(text, size);
  double const right = anchor.x + gap;
  double const left = anchor.x - gap - width;
  double const middle = anchor.x - width / 2.0;
  std::array const corners{Point{right, anchor.y - gap - size},      Point{right, anchor.y + gap},
                           Point{left, anchor.y - gap - size},       Point{left, anchor.y + gap},
                           Point{right, anchor.y - size / 2.0},      Point{left, anchor.y - size / 2.0},
                           Point{middle, anchor.y - 2 * gap - size}, Point{middle, anchor.y + 2 * gap}};
  for (auto const& corner : corners) {
    Box const box{corner, width, size};
    bool const is_free = std::ranges::none_of(taken_, [&](Box const& other) { return other.meets(box); });
    if (!is_free || !area_.contains(box)) continue;
    taken_.push_back(box);
    return Point{corner.x, corner.y + 0.8 * size};  // letters stand on four fifths of the height
  }
  return std::nullopt;
}

}  // namespace lapwing::dryrun::internal
