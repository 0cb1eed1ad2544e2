#include "video/camera/pattern_camera.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "base/text/utc_text.hpp"

namespace lapwing::video {

namespace {

cv::Mat colour_bars(cv::Size size) {
  std::array<cv::Scalar, 8> const colours = {{{235, 235, 235},
                                              {16, 235, 235},
                                              {235, 235, 16},
                                              {16, 235, 16},
                                              {235, 16, 235},
                                              {16, 16, 235},
                                              {235, 16, 16},
                                              {16, 16, 16}}};
  cv::Mat bars(size, CV_8UC3);
  auto const count = static_cast<int>(colours.size());
  for (int i = 0; i < count; ++i) {
    int const from = size.width * i / count;
    bars.colRange(from, size.width * (i + 1) / count).setTo(colours[static_cast<std::size_t>(i)]);
  }
  return bars;
}

}  // namespace

PatternCamera::PatternCamera(geo::Lens const& lens)
    : lens_(lens), bars_(colour_bars({lens.width_px, lens.height_px})) {}

base::Result<Frame> PatternCamera::take(Moment const& moment) {
  Frame frame{.picture = bars_.clone(), .taken = moment.at, .lens = lens_};
  double const height = frame.picture.rows;
  double const seconds = std::chrono::duration<double>(moment.at.time_since_epoch()).count();
  double const angle = 2.0 * std::numbers::pi * (seconds - std::floor(seconds));
  cv::Point2d const middle(0.5 * frame.picture.cols, 0.4 * height);
  cv::Point2d const tip = middle + cv::Point2d(std::sin(angle), -std::cos(angle)) * (0.3 * height);
  cv::circle(frame.picture, middle, static_cast<int>(0.3 * height), cv::Scalar(40, 40, 40), cv::FILLED, cv::LINE_AA);
  cv::line(frame.picture, middle, tip, cv::Scalar(240, 240, 240), std::max(1, frame.picture.rows / 90), cv::LINE_AA);
  // Letters of 22 pixels are those of scale 1.
  constexpr double letter_px = 22.0;
  double const scale = 0.06 * height / letter_px;
  cv::rectangle(frame.picture,
                cv::Rect(0, static_cast<int>(0.82 * height), frame.picture.cols, static_cast<int>(0.12 * height)),
                cv::Scalar(16, 16, 16), cv::FILLED);
  cv::putText(frame.picture, base::to_iso8601(moment.at),
              cv::Point(static_cast<int>(0.03 * height), static_cast<int>(0.905 * height)), cv::FONT_HERSHEY_SIMPLEX,
              scale, cv::Scalar(240, 240, 240), std::max(1, static_cast<int>(2.0 * scale)), cv::LINE_AA);
  return frame;
}

}  // namespace lapwing::video
