#pragma once

#include <string>

#include "base/error.hpp"
#include "host/eyes/look_frame.hpp"
#include "host/eyes/look_picture.hpp"

namespace lapwing::host {

inline constexpr auto shot_look = "shot";

/// A picture that `lapwing shoot` is to take: of a device of V4L2, an address (RTSP, HTTP), a video file, or the newest
/// one of a folder.
struct ShotQuestion {
  std::string source;
  int width_px = 0;  ///< that a device is asked for
  int height_px = 0;
  friend bool operator==(ShotQuestion const&, ShotQuestion const&) = default;
};

[[nodiscard]] LookFrame shot_request(ShotQuestion const& question);
/// Error, invalid_input: it names no source, or a size that cannot be.
[[nodiscard]] base::Result<ShotQuestion> shot_question_in(LookFrame const& request);

[[nodiscard]] LookFrame shot_answer(LookPicture picture);
/// Errors, invalid_input: what the refusal says; it is no picture.
[[nodiscard]] base::Result<LookPicture> shot_in(LookFrame answer);

}  // namespace lapwing::host
