#include "vision/cars/car_network.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

using base::ErrorKind;
using base::fail;

/// As training/cars/network.py shows it.
constexpr double grey = 114.0;
constexpr double contrast = 64.0;
/// Pixels of the network that a tile and the next one both see: the longest vehicle and some of its surroundings.
constexpr int common = 96;

/// Where tiles of `car_input` begin along a side, evenly, so that neighbours share at least `common`; on places of the
/// answer, which are joined.
std::vector<int> beginnings(int side) {
  if (side <= car_input) return {0};
  int const count = (side - common + car_input - common - 1) / (car_input - common);
  std::vector<int> all;
  for (int k = 0; k < count; ++k) {
    int const begin = k * (side - car_input) / (count - 1);
    all.push_back((begin + car_step - 1) / car_step * car_step);
  }
  return all;
}

cv::Mat squared(cv::Mat const& pixels) {
  cv::Mat square;
  cv::copyMakeBorder(pixels, square, 0, car_input - pixels.rows, 0, car_input - pixels.cols, cv::BORDER_CONSTANT,
                     cv::Scalar::all(grey));
  return square;
}

/// Nearer to the inside of the tile than to an edge that another tile sees better.
bool is_own(double at, int begin, int side) {
  bool const after_first = begin == 0 || at - begin >= common / 4.0;
  bool const before_last = begin + car_input >= side || begin + car_input - at >= common / 4.0;
  return after_first && before_last;
}

cv::Mat at_scale(cv::Mat const& pixels, double scale) {
  cv::Size const size(std::max(1, static_cast<int>(std::lround(pixels.cols * scale))),
                      std::max(1, static_cast<int>(std::lround(pixels.rows * scale))));
  cv::Mat scaled;
  cv::resize(pixels, scaled, size, 0.0, 0.0, scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  return scaled;
}

}  // namespace

base::Result<CarNetwork> CarNetwork::load(std::string const& network) {
  // OpenCV throws on what it cannot load, and a shape that does not fit shows only when the network runs.
  try {
    CarNetwork loaded(cv::dnn::readNetFromONNX(network.data(), network.size()));
    loaded.net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    (void)loaded.look_at_square(cv::Mat(car_input, car_input, CV_8UC3, cv::Scalar::all(grey)), 0.5);
    return loaded;
  } catch (cv::Exception const& error) {
    return fail(ErrorKind::invalid_input, "the network that finds cars cannot be loaded: " + error.err,
                "models/cars.onnx comes with the checkout; --method classic does without");
  }
}

cv::Mat CarNetwork::answer_to(cv::Mat const& square, Views views) {
  auto const shown = [](cv::Mat const& pixels) {
    constexpr bool to_rgb = true;
    return cv::dnn::blobFromImage(pixels, 1.0 / contrast, {}, cv::Scalar::all(grey), to_rgb);
  };
  net_.setInput(shown(square));
  if (views == Views::picture) return net_.forward();
  // The network's own memory, which the mirror image overwrites.
  cv::Mat answer = net_.forward().clone();
  cv::Mat mirrored;
  constexpr int left_to_right = 1;
  cv::flip(square, mirrored, left_to_right);
  net_.setInput(shown(mirrored));
  confirm(answer, net_.forward());
  return answer;
}

std::vector<SeenCar> CarNetwork::look_at_square(cv::Mat const& pixels, double least_score) {
  return cars_of_answer(answer_to(squared(pixels)), least_score);
}

Overhead CarNetwork::look(cv::Mat const& pixels, double metres_a_pixel, double least_score, Views views) {
  if (pixels.empty()) return {};
  double const scale = metres_a_pixel / car_metres;
  auto const scaled = at_scale(pixels, scale);
  Overhead seen{.cars = {},
                .covered = cv::Mat::zeros((scaled.rows + car_step - 1) / car_step,
                                          (scaled.cols + car_step - 1) / car_step, CV_32F),
                .covered_scale = scale / car_step};
  for (int const top : beginnings(scaled.rows)) {
    for (int const left : beginnings(scaled.cols)) {
      cv::Rect const tile(left, top, std::min(car_input, scaled.cols - left), std::min(car_input, scaled.rows - top));
      // Perhaps the network's own memory, which the next tile overwrites.
      auto const answer = answer_to(squared(scaled(tile)), views);
      for (auto car : cars_of_answer(answer, least_score)) {
        car.box.middle.x += left;
        car.box.middle.y += top;
        auto const& middle = car.box.middle;
        if (middle.x >= scaled.cols || middle.y >= scaled.rows) continue;
        if (is_own(middle.x, left, scaled.cols) && is_own(middle.y, top, scaled.rows)) seen.cars.push_back(car);
      }
      cv::Rect const place(left / car_step, top / car_step, (tile.width + car_step - 1) / car_step,
                           (tile.height + car_step - 1) / car_step);
      auto const within = place & cv::Rect(0, 0, seen.covered.cols, seen.covered.rows);
      cv::Mat target = seen.covered(within);
      cv::max(target, covered_of_answer(answer)(cv::Rect(0, 0, within.width, within.height)), target);
    }
  }
  seen.cars = each_once(std::move(seen.cars));
  for (auto& car : seen.cars) {
    car.box.middle = {car.box.middle.x / scale, car.box.middle.y / scale};
    car.box.length /= scale;
    car.box.width /= scale;
  }
  return seen;
}

}  // namespace lapwing::vision
