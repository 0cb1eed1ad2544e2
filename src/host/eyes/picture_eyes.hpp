#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "base/async/task.hpp"
#include "base/error.hpp"
#include "host/eyes/look_picture.hpp"
#include "host/eyes/looking_child.hpp"
#include "robot/poi/eye.hpp"

namespace lapwing::host {

/// One camera of a robot, whatever its pictures come from.
struct PictureSource {
  robot::CameraMount mount = {};
  /// What makes the picture, on the thread beside the loop: it touches nothing of the loop's.
  using Develop = std::move_only_function<LookPicture()>;
  /// Takes a picture at the moment that it is awaited. Errors: why there is none.
  std::function<base::Task<base::Result<Develop>>()> take = {};
};

/// Eyes whose pictures `child` looks at; it outlives them. They say what is wrong with them: a camera that gives no
/// pictures, nobody who looks; and nothing at all while a look takes longer than a look does.
[[nodiscard]] robot::Eyes eyes_with(base::Loop& loop, std::vector<PictureSource> for_tags,
                                    std::optional<PictureSource> ahead, LookingChild& child);

}  // namespace lapwing::host
