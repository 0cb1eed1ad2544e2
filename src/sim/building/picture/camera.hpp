#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sim/building/noise.hpp"
#include "sim/building/picture/picture.hpp"
#include "sim/building/picture/surfaces.hpp"
#include "sim/building/plan/building_plan.hpp"

namespace lapwing::sim::building {

/// A camera on a mast. Its lens does not distort: straight is straight.
struct CameraSettings {
  int width = 960;
  int height = 720;
  double view_rad = 0.94;  ///< from the left edge to the right one (seed 001)
  double x_m = 0.1;        ///< on the body
  double y_m = 0.0;
  double up_m = 0.9;
  double yaw_rad = 0.0;        ///< from straight ahead, to the left
  double pitch_rad = 0.2;      ///< upwards: signs hang higher than it stands
  double defocus_px = 0.5;     ///< standard deviation of the blur
  double exposure_s = 0.008;   ///< what turns meanwhile is blurred
  double noise = 0.008;        ///< standard deviation of each value, of the full scale
  double light = 1.0;          ///< 0 is night
  double corner_light = 0.85;  ///< what the lens lets through in its corners

  /// Pixels: what is `d` aside at range `r` is `focal_px() * d / r` aside in the picture.
  [[nodiscard]] double focal_px() const;
};

/// Where a camera stands and looks.
struct CameraPose {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
};
/// On a robot that stands there.
[[nodiscard]] CameraPose camera_on(Pose const& body, CameraSettings const& settings);

/// Where a point is in the picture, in pixels from its upper left corner; nothing for what lies behind the camera.
[[nodiscard]] std::optional<Eigen::Vector2d> pixel_of(Eigen::Vector3d const& point, CameraPose const& pose,
                                                      CameraSettings const& settings);

/// All that a picture is made of: a value, so that another thread can make it while the building goes on.
struct Shot {
  std::shared_ptr<std::vector<Surface> const> fixed;
  std::vector<Surface> moving;
  CameraPose pose;
  CameraSettings settings;
  double turn_rad_s = 0.0;  ///< of the camera, while the shutter is open
  Noise noise;
};

/// The picture, by a lens and a sensor as good as the settings say. Pure. Precondition: at least one pixel, at most 64
/// million.
[[nodiscard]] Picture develop(Shot const& shot);

}  // namespace lapwing::sim::building
