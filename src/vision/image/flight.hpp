#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <opencv2/core.hpp>

#include "geo/position.hpp"

namespace lapwing::vision {

/// What a drone wrote into its picture, by EXIF and XMP. What it did not say, or what makes no sense, is not there.
struct FlightRecord {
  std::optional<geo::Wgs84> place{};   ///< of the camera
  std::optional<double> height_m{};    ///< above where it took off: mostly the ground that is seen
  std::optional<double> yaw_rad{};     ///< of the camera's upper edge, clockwise from north
  std::optional<double> pitch_rad{};   ///< of the camera; straight down is -pi/2
  std::optional<double> focal_35mm{};  ///< focal length as on film of 36 by 24 mm
};

/// Of a JPEG file; of others an empty one.
[[nodiscard]] FlightRecord read_flight(std::span<std::byte const> file);

/// What a pixel measures on level ground below the camera, in metres. None unless height and focal length are known.
[[nodiscard]] std::optional<double> metres_a_pixel(FlightRecord const& flight, cv::Size const& picture);

/// Where a pixel lies on level ground below a camera that looks straight down. None unless place and direction are
/// known, and where the camera is tilted by more than some degrees: it would be wrong by metres.
[[nodiscard]] std::optional<geo::Wgs84> place_of(cv::Point2d const& pixel, cv::Size const& picture,
                                                 FlightRecord const& flight, double metres_a_pixel);

}  // namespace lapwing::vision
