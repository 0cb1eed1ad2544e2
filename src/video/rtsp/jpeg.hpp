#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::video {

/// A picture as it lies in memory: four bytes a pixel (blue, green, red, nothing), rows from above without gaps.
struct RawPicture {
  int width = 0;
  int height = 0;
  std::shared_ptr<std::string const> bytes = {};
};

inline constexpr int most_pixels_a_side = 4096;

/// Reads a JPEG. Error: invalid_input: it is none, it is torn, or it says to be larger than `most_pixels_a_side`.
[[nodiscard]] base::Result<RawPicture> read_jpeg(std::string_view jpeg);

}  // namespace lapwing::video
