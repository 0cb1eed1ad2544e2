#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/text/diagnostic.hpp"
#include "robot/views/camera_mount.hpp"

namespace lapwing::host {

/// A camera on a robot that is no simulated one.
struct RobotCamera {
  enum class Kind : std::uint8_t {
    source,  ///< a device of V4L2, an address or a video file, by `lapwing shoot`
    folder,  ///< the newest picture that lies there, likewise
    topic,   ///< of ROS 2
  };
  std::string robot = "robot1";
  Kind kind = Kind::source;
  std::string from;  ///< device, address, file or folder; topic as ROS names it
  robot::CameraMount mount = {};
  bool photographs = false;  ///< `photograph()` uses this one
};

/// Reads the text of a file of cameras (docs/guide/robots.md#cameras); paths in it count from its folder. Everything
/// wrong is reported; the result is to be used only when nothing was.
[[nodiscard]] std::vector<RobotCamera> read_robot_cameras(base::SourceFile const& source,
                                                          base::Diagnostics& diagnostics);
/// Those of the file; none where it is empty. Error, invalid_input: it has mistakes, which have been shown.
[[nodiscard]] base::Result<std::vector<RobotCamera>> load_robot_cameras(std::string const& file);
inline constexpr auto robot_cameras_help =
    "TOML file with the cameras of robots on a line or on ROS 2: where their pictures come from and how they sit";

}  // namespace lapwing::host
