#pragma once

#include <filesystem>

#include "base/config.hpp"
#include "video/camera/camera.hpp"

namespace lapwing::video {

/// Settings of a camera as people write them (TOML; docs/reference/car-park-worlds.md): the table `[camera]` of a
/// process's configuration. Files are named from `beside`, the folder of that file. Everything wrong is reported with
/// its place; what is returned then is of no use.
[[nodiscard]] CameraSettings read_camera(base::ConfigReader& table, std::filesystem::path const& beside);

}  // namespace lapwing::video
