#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include <opencv2/videoio.hpp>

#include "video/camera/camera.hpp"
#include "video/camera/picture_clock.hpp"

namespace lapwing::video {

/// A source that lies elsewhere (`rtsp://...`), and is no file or device of this machine.
[[nodiscard]] bool is_address(std::string_view source);
/// For people: without the name and password that an address may carry.
[[nodiscard]] std::string without_secrets(std::string_view source);

/// A camera of V4L2 (`/dev/video0`), a stream (RTSP, HTTP) or a video file, which is played at its own pace. A thread
/// of its own reads all the time, so that what waits in drivers and on the way does not grow old; it makes a picture
/// only of the one that comes next after `take` asked, and keeps none.
class VideoCamera final : public Camera {
 public:
  /// Takes up to some seconds. Errors: not_found: no such file or device; io: no pictures can be had from it.
  [[nodiscard]] static base::Result<std::unique_ptr<Camera>> open(CameraSettings const& settings);
  /// Waits for the picture that is being read: `longest_silence` at most, or what the driver of a device takes.
  ~VideoCamera() override;

  [[nodiscard]] base::Result<Frame> take(Moment const& moment) override;
  [[nodiscard]] geo::Lens const& lens() const override { return lens_; }

 private:
  enum class Origin : std::uint8_t { file, device, address };

  VideoCamera(std::string name, Origin origin, CameraSettings const& settings, cv::VideoCapture const& capture);
  [[nodiscard]] static Origin origin_of(std::string const& source);
  [[nodiscard]] static std::optional<base::Error> why_absent(std::string const& source, Origin origin);
  void read(std::stop_token const& stop);
  /// Until the next picture of a file is due. False: it is to end.
  bool keep_pace(base::Duration position, std::stop_token const& stop);
  [[nodiscard]] base::UtcTime time_of(base::Duration position);
  [[nodiscard]] base::Result<Frame> frame_at(base::UtcTime taken);
  void end();

  // The thread's alone, once it runs:
  cv::VideoCapture capture_;
  PictureClock clock_;
  std::optional<std::chrono::steady_clock::time_point> begin_;  ///< when a file's first picture was due

  std::string const name_;
  Origin const origin_;
  geo::Lens const lens_;
  base::Duration const delay_;  ///< that no source tells: of the camera, the way and the decoder

  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool is_asked_ = false;
  bool has_ended_ = false;
  std::optional<base::Result<Frame>> frame_;
  std::jthread thread_;  ///< last: it uses the others
};

}  // namespace lapwing::video
