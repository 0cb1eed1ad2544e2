#pragma once

#include <array>
#include <optional>
#include <string>

#include "geo/position.hpp"

namespace lapwing::vision {

/// In pixels, as a box.
struct Point {
  double x = 0.0;
  double y = 0.0;

  friend bool operator==(Point const&, Point const&) = default;
};

/// In pixels; x to the right, y down, from the upper left corner of the picture.
struct Box {
  double x = 0.0;
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;

  [[nodiscard]] double area() const { return width * height; }
  friend bool operator==(Box const&, Box const&) = default;
};

/// The part of two boxes' union that both cover: 0 apart, 1 the same.
[[nodiscard]] double overlap(Box const& a, Box const& b);

/// Something that was found in a picture.
struct Detection {
  std::string category;  ///< "door", "sign", "car", "slot"
  Box box;
  double score = 0.0;                 ///< 0 to 1, more is surer
  std::optional<std::string> text{};  ///< what is written there: the room's number, if there is one
  std::optional<std::string> kind{};  ///< what kind of room it says: "office", "stairs", ...
  /// Of a door or a sign: upper left, upper right, lower right, lower left, as it is seen. Of a car or a slot: in order
  /// round it.
  std::optional<std::array<Point, 4>> corners{};
  std::optional<double> occupied_chance{};  ///< of a slot: that a vehicle stands there; none where that is not seen
  std::optional<geo::Wgs84> place{};        ///< of its middle, on the ground
};

}  // namespace lapwing::vision
