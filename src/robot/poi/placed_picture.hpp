#pragma once

#include "map/features/contents.hpp"
#include "robot/views/camera_mount.hpp"
#include "vehicle/place.hpp"

namespace lapwing::robot {

/// Where a picture was taken from and where the camera looked, of one on a robot that stood there; the rest of it is
/// the caller's to say.
[[nodiscard]] map::Picture placed_picture(CameraMount const& mount, vehicle::SitePose const& body);

}  // namespace lapwing::robot
