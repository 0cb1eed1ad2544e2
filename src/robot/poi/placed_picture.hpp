#pragma once

#include <string>
#include <vector>

#include "map/features/contents.hpp"
#include "map/live/live_map.hpp"
#include "robot/views/camera_mount.hpp"
#include "robot/views/tag_place.hpp"
#include "vehicle/place.hpp"

namespace lapwing::robot {

/// Where a picture was taken from and where the camera looked, of one on a robot that stood there; the rest of it is
/// the caller's to say.
[[nodiscard]] map::Picture placed_picture(CameraMount const& mount, vehicle::SitePose const& body);

/// What was photographed goes with the map that has moved. Takes out of `ids` those that the map has no more.
void move_pictures(map::LiveMap& live_map, std::vector<std::string>& ids, MapMove const& moved,
                   map::Account const& account);

}  // namespace lapwing::robot
