#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "base/async/loop.hpp"
#include "base/log.hpp"
#include "bus/participant/bus.hpp"
#include "host/eyes/looking_child.hpp"
#include "host/eyes/picture_eyes.hpp"
#include "host/robots/robot_cameras.hpp"

namespace lapwing::host {

/// Opens a bus of ROS 2 for a robot's topics; called when the first is needed.
using OpenBus = std::function<base::Result<std::unique_ptr<bus::Bus>>()>;

/// The cameras of one robot, as sources of pictures.
struct CameraSources {
  std::vector<PictureSource> for_tags;
  std::optional<PictureSource> ahead;
};

/// Those of `cameras` that are `robot`'s. Each device, address or folder has a program of its own that takes its
/// pictures: `shooter`. What is wrong with a camera is said once, and that it is over. Errors: invalid_input for a
/// topic of a robot that is not on ROS 2 (`open_bus` is empty), and those of the bus.
[[nodiscard]] base::Result<CameraSources> camera_sources(base::Loop& loop, std::vector<RobotCamera> const& cameras,
                                                         std::string const& robot,
                                                         LookingChild::Settings const& shooter, OpenBus const& open_bus,
                                                         base::Logger const& log);

}  // namespace lapwing::host
