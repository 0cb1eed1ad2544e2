#pragma once

#include "vision/detection.hpp"

namespace lapwing::robot {

/// A camera on a robot, by what its maker and who screwed it on say. Its lens does not distort.
struct CameraMount {
  int width_px = 960;
  int height_px = 720;
  double view_rad = 0.94;  ///< from the left edge of the picture to the right one
  double x_m = 0.1;        ///< on the body: ahead
  double y_m = 0.0;        ///< to the left
  double up_m = 0.9;
  double yaw_rad = 0.0;    ///< from straight ahead, to the left
  double pitch_rad = 0.2;  ///< upwards
};

/// The way from a camera to what is seen at one point of its picture.
struct SightLine {
  double bearing_rad = 0.0;  ///< on the body, counterclockwise from straight ahead
  double slope = 0.0;        ///< metres up for each metre along the floor
};

/// That what hangs at this height, so far off along the floor, is neither above nor below the picture nor cut off by
/// its edge.
[[nodiscard]] bool is_in_the_picture(CameraMount const& mount, double height_m, double range_m);

[[nodiscard]] SightLine sight_line(CameraMount const& mount, vision::Point const& pixel);

}  // namespace lapwing::robot
