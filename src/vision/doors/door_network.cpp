#include "vision/doors/door_network.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/doors/door_answer.hpp"

namespace lapwing::vision {

namespace {

using base::ErrorKind;
using base::fail;

/// The whole picture in the middle of a square, RGB; what the picture leaves of it is 0.
struct Shown {
  cv::Mat blob;
  double scale = 1.0;  ///< from the picture to the square
  double left = 0.0;   ///< of the picture in the square
  double top = 0.0;
};

/// As training/doors/pictures.py shows it.
constexpr double grey = 114.0;
constexpr double contrast = 64.0;

Shown shown(cv::Mat const& pixels) {
  Shown out;
  out.scale = static_cast<double>(answer_input) / std::max(pixels.cols, pixels.rows);
  cv::Size const size(std::clamp(static_cast<int>(std::lround(pixels.cols * out.scale)), 1, answer_input),
                      std::clamp(static_cast<int>(std::lround(pixels.rows * out.scale)), 1, answer_input));
  cv::Mat small;
  cv::resize(pixels, small, size, 0.0, 0.0, out.scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::Mat square(answer_input, answer_input, CV_8UC3, cv::Scalar::all(grey));
  cv::Rect const place((answer_input - size.width) / 2, (answer_input - size.height) / 2, size.width, size.height);
  small.copyTo(square(place));
  out.left = place.x;
  out.top = place.y;
  constexpr bool to_rgb = true;
  out.blob = cv::dnn::blobFromImage(square, 1.0 / contrast, {}, cv::Scalar::all(grey), to_rgb);
  return out;
}

cv::Mat mirrored(cv::Mat const& blob) {
  cv::Mat out = blob.clone();
  for (int channel = 0; channel < 3; ++channel) {
    cv::Mat plane(answer_input, answer_input, CV_32F, out.ptr(0, channel));
    cv::flip(plane, plane, 1);
  }
  return out;
}

Box in_picture(Box const& box, Shown const& from, cv::Size const& size) {
  double const left = std::clamp<double>((box.x - from.left) / from.scale, 0.0, size.width);
  double const top = std::clamp<double>((box.y - from.top) / from.scale, 0.0, size.height);
  double const right = std::clamp<double>((box.x + box.width - from.left) / from.scale, 0.0, size.width);
  double const bottom = std::clamp<double>((box.y + box.height - from.top) / from.scale, 0.0, size.height);
  return {.x = left, .y = top, .width = right - left, .height = bottom - top};
}

}  // namespace

base::Result<DoorNetwork> DoorNetwork::load(std::string const& network) {
  // OpenCV throws on what it cannot load, and a shape that does not fit shows only when the network runs.
  try {
    DoorNetwork loaded(cv::dnn::readNetFromONNX(network.data(), network.size()));
    loaded.net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    (void)loaded.find(cv::Mat(answer_input, answer_input, CV_8UC3, cv::Scalar::all(grey)), 0.5);
    return loaded;
  } catch (cv::Exception const& error) {
    return fail(ErrorKind::invalid_input, "the network that finds doors cannot be loaded: " + error.err,
                "models/doors.onnx comes with the checkout; --method classic does without");
  }
}

std::vector<Detection> DoorNetwork::find(cv::Mat const& pixels, double least_score) {
  if (pixels.empty()) return {};
  auto const square = shown(pixels);
  net_.setInput(square.blob);
  // The network's own memory, which the next picture overwrites.
  auto const straight = doors_of_answer(net_.forward());
  net_.setInput(mirrored(square.blob));
  auto const flipped = mirrored_back(doors_of_answer(net_.forward()));
  std::vector<Detection> doors;
  for (auto const& door : agreed(straight, flipped)) {
    auto const score = chance_of(door.surety);
    if (score < least_score) continue;
    auto const box = in_picture(door.box, square, pixels.size());
    if (box.width < 1.0 || box.height < 1.0) continue;
    doors.push_back({.category = "door", .box = box, .score = score});
  }
  std::ranges::stable_sort(doors, std::ranges::greater(), &Detection::score);
  return doors;
}

}  // namespace lapwing::vision
