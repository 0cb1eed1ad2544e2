#pragma once

#include <string>

#include "base/error.hpp"
#include "bus/messages/images.hpp"

namespace lapwing::robot::ros {

/// A picture of a ROS topic, for who looks at it.
struct RosPicture {
  /// Red, green, blue, row by row from the top; where there is no size: a JPEG or PNG file.
  std::string bytes;
  int width = 0;
  int height = 0;
  friend bool operator==(RosPicture const&, RosPicture const&) = default;
};

/// Errors, invalid_input: an encoding other than rgb8, bgr8, rgba8, bgra8 and mono8; fewer bytes than its size takes;
/// more than 40 million pixels, or none.
[[nodiscard]] base::Result<RosPicture> picture_of(bus::Image const& image);
/// Error, invalid_input: it is empty.
[[nodiscard]] base::Result<RosPicture> picture_of(bus::CompressedImage const& image);

}  // namespace lapwing::robot::ros
