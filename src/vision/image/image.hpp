#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <opencv2/core.hpp>

#include "base/error.hpp"
#include "vision/detection.hpp"

namespace lapwing::vision {

/// Larger ones are refused before anything is decoded: a file of a few kilobytes can say that it is a picture of
/// gigabytes.
inline constexpr std::size_t max_picture_bytes = std::size_t{128} << 20;
inline constexpr std::size_t max_pixels = 64'000'000;

/// How a camera was held, as EXIF counts it: 1 is upright, 3 upside down, 6 and 8 on its sides, the rest mirrored.
enum class Orientation : int {
  upright = 1,
  mirrored,
  rotated_180,
  mirrored_180,
  mirrored_270,
  rotated_90,
  mirrored_90,
  rotated_270
};

/// A picture as it is stored, and as people see it. Detectors look at the latter; what they find is told of the former.
struct Image {
  cv::Mat stored;  ///< BGR, 8 bits
  Orientation orientation = Orientation::upright;

  [[nodiscard]] cv::Mat upright() const;
  [[nodiscard]] Box to_stored(Box const& of_upright) const;
};

/// JPEG, PNG and WebP. Anything else, what is cut off and what is too large is refused; the message does not name the
/// file.
[[nodiscard]] base::Result<Image> decode_image(std::span<std::byte const> bytes);
/// As a JPEG file.
[[nodiscard]] std::string encode_jpeg(cv::Mat const& pixels);

}  // namespace lapwing::vision
