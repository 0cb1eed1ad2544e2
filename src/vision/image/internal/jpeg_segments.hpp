#pragma once

#include <vector>

#include "vision/image/internal/bytes.hpp"

namespace lapwing::vision::internal {

struct JpegSegment {
  std::uint32_t marker = 0;  ///< 0xC0 to 0xFE
  Bytes body;                ///< of the start of the coded data, which is the last one: all that follows
};

inline constexpr std::uint32_t jpeg_app1 = 0xE1;
inline constexpr std::uint32_t jpeg_coded_data = 0xDA;

/// What a JPEG file says before its coded data, and that. It ends early where the file does not make sense.
[[nodiscard]] std::vector<JpegSegment> jpeg_segments(Bytes file);

}  // namespace lapwing::vision::internal
