#include "video/camera/camera.hpp"

#include <fmt/format.h>

#include "video/camera/folder_camera.hpp"
#include "video/camera/pattern_camera.hpp"
#include "video/camera/simulated_camera.hpp"
#include "video/camera/video_camera.hpp"
#include "video/files/file_bytes.hpp"
#include "video/world/car_park_file.hpp"

namespace lapwing::video {

namespace {

constexpr int most_side_px = 8'192;
constexpr int least_side_px = 16;

/// Why no picture can be made by the settings.
std::optional<std::string> fault_of(CameraSettings const& settings) {
  auto const& lens = settings.lens;
  if (auto const fault = geo::lens_fault(lens)) return "the camera has no sound lens: " + *fault;
  if (lens.width_px > most_side_px || lens.height_px > most_side_px || lens.width_px < least_side_px ||
      lens.height_px < least_side_px)
    return fmt::format("a camera has {} to {} pixels a side, not {} by {}", least_side_px, most_side_px, lens.width_px,
                       lens.height_px);
  auto const& faults = settings.faults;
  constexpr double most_noise = 30.0;
  constexpr double most_blur_px = 20.0;
  if (!(faults.noise >= 0.0 && faults.noise <= most_noise)) return fmt::format("noise is 0 to {}", most_noise);
  if (!(faults.blur_px >= 0.0 && faults.blur_px <= most_blur_px))
    return fmt::format("blur_px is 0 to {}", most_blur_px);
  if (!(faults.position_m >= 0.0 && faults.angle_rad >= 0.0) || faults.delay < base::Duration::zero())
    return "the camera's faults are not negative";
  return std::nullopt;
}

base::Result<std::unique_ptr<Camera>> open_simulated(CameraSettings const& settings) {
  auto park = load_car_park(settings.world);
  if (!park) return std::unexpected(park.error());
  cv::Mat photograph;
  if (park->picture) {
    auto picture = picture_of(park->picture->file);
    if (!picture) return std::unexpected(picture.error());
    photograph = *picture;
  }
  return std::make_unique<SimulatedCamera>(settings, std::move(*park), photograph);
}

}  // namespace

geo::CameraPlace camera_on(BodyPlace const& drone, Mount const& mount) {
  // A camera of the body looks along -z with its upper edge ahead; geo::camera_at has that of a frame whose x is there.
  auto const looking = geo::camera_at({}, mount.yaw_rad, mount.tilt_rad).rotation();
  Eigen::Quaterniond const body = mount.has_gimbal
                                      ? Eigen::Quaterniond(Eigen::AngleAxisd(drone.yaw_rad(), Eigen::Vector3d::UnitZ()))
                                      : drone.rotation();
  return {drone * geo::Point3<BodyFrame>(mount.at.v), body * looking};
}

base::Result<std::unique_ptr<Camera>> open_camera(CameraSettings const& settings) {
  if (auto const fault = fault_of(settings)) return base::fail(base::ErrorKind::invalid_input, *fault);
  switch (settings.kind) {
    case CameraSettings::Kind::simulated: return open_simulated(settings);
    case CameraSettings::Kind::folder: return FolderCamera::open(settings);
    case CameraSettings::Kind::pattern: return std::make_unique<PatternCamera>(settings.lens);
    case CameraSettings::Kind::video: return VideoCamera::open(settings);
  }
  return base::fail(base::ErrorKind::invalid_input, "there is no such kind of camera");
}

}  // namespace lapwing::video
