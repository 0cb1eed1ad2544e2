#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "host/eyes/look_frame.hpp"

namespace lapwing::host {

inline constexpr std::int64_t most_look_pixels = 40'000'000;

/// A picture for who looks at it.
struct LookPicture {
  std::string bytes;
  /// Of raw pixels, three bytes each: red, green, blue, row by row from the top; 0: `bytes` are a JPEG, PNG or WebP
  /// file.
  int width = 0;
  int height = 0;
};

/// Into a request: its body, `width` and `height`.
void put_picture(LookFrame& request, LookPicture picture);
/// Out of one, whose body it takes. Errors, invalid_input: pixels that are not as many as the head says.
[[nodiscard]] base::Result<LookPicture> take_picture(LookFrame& request);

}  // namespace lapwing::host
