#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "host/eyes/look_picture.hpp"
#include "vision/detection.hpp"

namespace lapwing::host {

/// A sign, and its part of the picture from the front, as a JPEG file.
struct SignSeen {
  vision::Detection sign;
  std::string crop = {};
};

/// What signs show in a picture.
struct SignsSeen {
  std::vector<SignSeen> signs = {};
  bool is_sharp = true;  ///< all of them, enough to be read
};

/// What requests for signs name in `look`.
inline constexpr auto sign_look = "signs";

[[nodiscard]] LookFrame sign_request(LookPicture picture);
[[nodiscard]] LookFrame sign_answer(SignsSeen seen);
/// Errors, invalid_input: it is none; what it says is wrong with the picture.
[[nodiscard]] base::Result<SignsSeen> signs_in(LookFrame const& answer);

}  // namespace lapwing::host
