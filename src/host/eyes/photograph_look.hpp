#pragma once

#include <string>

#include "base/error.hpp"
#include "host/eyes/look_picture.hpp"

namespace lapwing::host {

/// A picture as it is kept: JPEG files of all of it and of a small copy.
struct KeptPicture {
  std::string jpeg = {};
  std::string thumbnail = {};
  int width = 0;
  int height = 0;
};

/// What requests for such files name in `look`.
inline constexpr auto photograph_look = "photograph";

[[nodiscard]] LookFrame photograph_request(LookPicture picture);
[[nodiscard]] LookFrame photograph_answer(KeptPicture const& picture);
/// Errors, invalid_input: it is none; what it says is wrong with the picture.
[[nodiscard]] base::Result<KeptPicture> photograph_in(LookFrame const& answer);

}  // namespace lapwing::host
