#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/error.hpp"
#include "vision/image/image.hpp"

namespace lapwing::vision::internal {

/// What the first bytes of a file say of the picture in it.
struct PictureHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Orientation orientation = Orientation::upright;
};

/// Refuses what is none of the formats, what has no size, and JPEGs that end before their picture does: decoders fill
/// what is missing with grey.
[[nodiscard]] base::Result<PictureHeader> read_header(std::span<std::byte const> bytes);

}  // namespace lapwing::vision::internal
