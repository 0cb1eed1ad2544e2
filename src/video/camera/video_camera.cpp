#include "video/camera/video_camera.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/wall_clock.hpp"

namespace lapwing::video {

using namespace std::chrono_literals;

namespace {

/// A stream that is silent for so long counts as lost.
constexpr std::chrono::milliseconds longest_silence = 3s;
/// How long a call waits for the next picture.
constexpr base::Duration patience = 1s;
/// Files tell when pictures are due, and may tell nonsense.
constexpr base::Duration longest_pause = 1s;

std::vector<int> with_timeouts() {
  auto const silence_ms = static_cast<int>(longest_silence.count());
  return {cv::CAP_PROP_OPEN_TIMEOUT_MSEC, silence_ms, cv::CAP_PROP_READ_TIMEOUT_MSEC, silence_ms};
}

/// What the source says, which may be nonsense.
base::Duration position_of(cv::VideoCapture const& capture) {
  constexpr double farthest_ms = 1e12;  // 30 years
  double const told_ms = capture.get(cv::CAP_PROP_POS_MSEC);
  return told_ms >= 0.0 && told_ms <= farthest_ms ? base::from_seconds(told_ms * 1e-3) : base::Duration::zero();
}

}  // namespace

bool is_address(std::string_view source) {
  return source.contains("://");
}

std::string without_secrets(std::string_view source) {
  auto const scheme_end = source.find("://");
  if (scheme_end == std::string_view::npos) return std::string(source);
  auto const host = scheme_end + 3;
  auto const at = source.substr(0, source.find('/', host)).rfind('@');
  if (at == std::string_view::npos || at < host) return std::string(source);
  return std::string(source.substr(0, host)).append(source.substr(at + 1));
}

VideoCamera::Origin VideoCamera::origin_of(std::string const& source) {
  if (is_address(source)) return Origin::address;
  return source.starts_with("/dev/") ? Origin::device : Origin::file;
}

std::optional<base::Error> VideoCamera::why_absent(std::string const& source, Origin origin) {
  std::error_code error;
  if (origin == Origin::address || std::filesystem::exists(source, error)) return std::nullopt;
  if (origin == Origin::device)
    return base::Error{base::ErrorKind::not_found, fmt::format("there is no camera at {}", source),
                       "plug it in; `ls /dev/video*` shows those that are there"};
  return base::Error{base::ErrorKind::not_found, fmt::format("there is no video file {}", source), ""};
}

base::Result<std::unique_ptr<Camera>> VideoCamera::open(CameraSettings const& settings) {
  auto const& source = settings.source;
  auto const origin = origin_of(source);
  if (auto absent = why_absent(source, origin)) return std::unexpected(*std::move(absent));
  cv::VideoCapture capture;
  if (origin == Origin::device)
    capture.open(
        source, cv::CAP_V4L2,
        {cv::CAP_PROP_FRAME_WIDTH, settings.lens.width_px, cv::CAP_PROP_FRAME_HEIGHT, settings.lens.height_px});
  else
    capture.open(source, cv::CAP_FFMPEG, with_timeouts());
  auto name = without_secrets(source);
  if (!capture.isOpened())
    return base::fail(base::ErrorKind::io, fmt::format("no pictures can be had from {}", name),
                      origin == Origin::device ? "is it another program's, or is the user not in the group `video`?"
                                               : "try the same source in a player such as ffplay or VLC");
  return std::unique_ptr<Camera>(new VideoCamera(std::move(name), origin, settings, capture));
}

VideoCamera::VideoCamera(std::string name, Origin origin, CameraSettings const& settings,
                         cv::VideoCapture const& capture)
    : capture_(capture), name_(std::move(name)), origin_(origin), lens_(settings.lens), delay_(settings.faults.delay) {
  thread_ = std::jthread([this](std::stop_token const& stop) { read(stop); });
}

VideoCamera::~VideoCamera() {
  thread_.request_stop();
}

base::Result<Frame> VideoCamera::take(Moment const&) {
  std::unique_lock lock(mutex_);
  is_asked_ = true;
  changed_.wait_for(lock, patience, [this] { return frame_ || has_ended_; });
  is_asked_ = false;
  if (frame_) return *std::exchange(frame_, std::nullopt);
  if (!has_ended_)
    return base::fail(base::ErrorKind::timed_out,
                      fmt::format("no picture has come from {} for {} s", name_, base::to_seconds(patience)));
  if (origin_ == Origin::file)
    return base::fail(base::ErrorKind::lost, fmt::format("the video {} has come to its end", name_));
  return base::fail(base::ErrorKind::lost, fmt::format("the pictures of {} have ended", name_),
                    "it is tried again; is the camera powered and connected?");
}

void VideoCamera::read(std::stop_token const& stop) {
  while (!stop.stop_requested() && capture_.grab()) {
    auto const position = position_of(capture_);
    if (origin_ == Origin::file && !keep_pace(position, stop)) return;
    auto const taken = time_of(position) - delay_;
    {
      std::scoped_lock const lock(mutex_);
      if (!is_asked_ || frame_) continue;
    }
    auto frame = frame_at(taken);
    std::scoped_lock const lock(mutex_);
    if (!is_asked_) continue;  // who asked has lost patience, and the next one is to have a newer one
    frame_ = std::move(frame);
    changed_.notify_all();
  }
  end();
}

bool VideoCamera::keep_pace(base::Duration position, std::stop_token const& stop) {
  auto const now = std::chrono::steady_clock::now();
  if (!begin_) begin_ = now - position;
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, stop, std::min(*begin_ + position, now + longest_pause), [] { return false; });
  return !stop.stop_requested();
}

base::UtcTime VideoCamera::time_of(base::Duration position) {
  auto const arrived = base::wall_now();
  // V4L2 tells when the light fell in, or when the driver had the first byte, by the clock since the start.
  auto const age = std::chrono::steady_clock::now().time_since_epoch() - position;
  if (origin_ == Origin::device && age >= 0s && age < longest_silence) return arrived - age;
  return clock_.taken(position, arrived);
}

base::Result<Frame> VideoCamera::frame_at(base::UtcTime taken) {
  cv::Mat picture;
  try {
    capture_.retrieve(picture);
  } catch (cv::Exception const& error) {
    return base::fail(base::ErrorKind::io, fmt::format("a picture of {} cannot be read: {}", name_, error.err));
  }
  if (picture.empty() || picture.type() != CV_8UC3)
    return base::fail(base::ErrorKind::io, fmt::format("a picture of {} cannot be read", name_));
  if (picture.cols != lens_.width_px || picture.rows != lens_.height_px)
    return base::fail(base::ErrorKind::io,
                      fmt::format("{} has pictures of {} by {} pixels, and the camera's lens {} by {}", name_,
                                  picture.cols, picture.rows, lens_.width_px, lens_.height_px),
                      "set width and height, and what they change of the lens, to those of the pictures");
  return Frame{.picture = std::move(picture), .taken = taken, .lens = lens_};
}

void VideoCamera::end() {
  std::scoped_lock const lock(mutex_);
  has_ended_ = true;
  changed_.notify_all();
}

}  // namespace lapwing::video
