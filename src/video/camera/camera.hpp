#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <opencv2/core.hpp>

#include "base/error.hpp"
#include "base/time.hpp"
#include "geo/camera/ground_view.hpp"
#include "geo/camera/lens.hpp"
#include "geo/position.hpp"

/// Pictures from a camera on a drone, whatever the camera is: a real one, one that renders a simulated car park, a
/// folder of pictures that were taken before, or a test pattern.
namespace lapwing::video {

/// Frame of a drone's body: x ahead, y to the left, z up (REP 103).
struct BodyFrame {};
/// Where a drone is in the local frame of the bus ("map": east, north, up), and how it is turned.
using BodyPlace = geo::Transform3<geo::SiteFrame, BodyFrame>;

/// How a camera sits on a drone.
struct Mount {
  geo::Vector3<BodyFrame> at = {};  ///< of the lens, from where the drone says that it is
  double yaw_rad = 0.0;             ///< where the upper edge of the picture points: counterclockwise from ahead
  double tilt_rad = 0.0;            ///< 0 looks straight down, pi/2 ahead
  /// A gimbal keeps the camera level while the drone rolls and pitches: of the drone's angles its yaw alone counts.
  bool has_gimbal = true;
};
[[nodiscard]] geo::CameraPlace camera_on(BodyPlace const& drone, Mount const& mount);

/// What the drone knows of its camera when it asks for a picture.
struct Moment {
  geo::CameraPlace site_from_camera = {};
  base::UtcTime at;
};

struct Frame {
  cv::Mat picture;      ///< BGR, 8 bits
  base::UtcTime taken;  ///< when the light fell in: some time before it was handed over
  geo::Lens lens;       ///< of this picture's size
  /// Where the camera was by the picture itself, or by what was written beside it; without it, whoever has the
  /// frame looks up where the drone was when it was taken.
  std::optional<geo::CameraPlace> site_from_camera = {};
};

/// A source of pictures. One call at a time; a call may compute for some tens of milliseconds or read a file, so it
/// belongs on a pool.
class Camera {
 public:
  Camera() = default;
  Camera(Camera const&) = delete;
  Camera& operator=(Camera const&) = delete;
  virtual ~Camera() = default;

  /// The newest picture. Errors, for people: timed_out: none within its time, the next call may have one; io: this
  /// one could not be read, the next call goes on behind it; lost: the camera is gone, or a folder or video has come to
  /// its end: no call will have one again, and who wants more opens it anew.
  [[nodiscard]] virtual base::Result<Frame> take(Moment const& moment) = 0;
  [[nodiscard]] virtual geo::Lens const& lens() const = 0;
};

/// A simulated camera's faults. All are drawn by its seed.
struct CameraFaults {
  double noise = 2.0;    ///< standard deviation of each value, of 255
  double blur_px = 0.6;  ///< standard deviation
  /// How far the camera really is from where the drone says, level and up each, and how far it is turned about each
  /// axis: standard deviations, another way every few seconds.
  double position_m = 0.0;
  double angle_rad = 0.0;
  base::Duration delay = {};   ///< from the light that falls in until the picture can be had
  double missing_share = 0.0;  ///< of pictures that do not come within their time
};

/// Which camera, and how good it is.
struct CameraSettings {
  enum class Kind : std::uint8_t { simulated, folder, pattern, video };
  Kind kind = Kind::simulated;
  geo::Lens lens = geo::pinhole(1280, 720, 1.0821);  ///< 62 degrees across
  Mount mount = {};
  std::filesystem::path world = {};  ///< simulated: the world file
  /// Of the frame in which the poses are told, where that is not the world file's.
  std::optional<geo::Wgs84> anchor = {};
  std::filesystem::path folder = {};  ///< folder: the pictures, and poses.csv beside them
  std::string source = {};            ///< video: a device of V4L2, an address, or a file
  std::uint64_t seed = 1;             ///< of the faults; the world has its own
  CameraFaults faults = {};
};

/// Errors: not_found, io: a file or camera is not there or cannot be read; invalid_input: what is wrong with it, or
/// with the lens or another setting.
[[nodiscard]] base::Result<std::unique_ptr<Camera>> open_camera(CameraSettings const& settings);

}  // namespace lapwing::video
