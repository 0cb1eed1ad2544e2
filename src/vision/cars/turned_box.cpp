#include "vision/cars/turned_box.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::vision {

std::array<Point, 4> corners_of(TurnedBox const& box) {
  double const along_x = 0.5 * box.length * std::cos(box.heading_rad);
  double const along_y = 0.5 * box.length * std::sin(box.heading_rad);
  double const across_x = -0.5 * box.width * std::sin(box.heading_rad);
  double const across_y = 0.5 * box.width * std::cos(box.heading_rad);
  auto const at = [&](double along, double across) {
    return Point{box.middle.x + along * along_x + across * across_x,
                 box.middle.y + along * along_y + across * across_y};
  };
  return {at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0), at(-1.0, -1.0)};
}

Box upright_box(TurnedBox const& box, cv::Size const& picture) {
  double const half_width =
      0.5 * (box.length * std::abs(std::cos(box.heading_rad)) + box.width * std::abs(std::sin(box.heading_rad)));
  double const half_height =
      0.5 * (box.length * std::abs(std::sin(box.heading_rad)) + box.width * std::abs(std::cos(box.heading_rad)));
  double const left = std::clamp<double>(box.middle.x - half_width, 0.0, picture.width);
  double const top = std::clamp<double>(box.middle.y - half_height, 0.0, picture.height);
  return {.x = left,
          .y = top,
          .width = std::clamp<double>(box.middle.x + half_width, 0.0, picture.width) - left,
          .height = std::clamp<double>(box.middle.y + half_height, 0.0, picture.height) - top};
}

bool contains(TurnedBox const& box, Point const& point) {
  double const x = point.x - box.middle.x;
  double const y = point.y - box.middle.y;
  double const along = x * std::cos(box.heading_rad) + y * std::sin(box.heading_rad);
  double const across = y * std::cos(box.heading_rad) - x * std::sin(box.heading_rad);
  return std::abs(along) <= 0.5 * box.length && std::abs(across) <= 0.5 * box.width;
}

}  // namespace lapwing::vision
