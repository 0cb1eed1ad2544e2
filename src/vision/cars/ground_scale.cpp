#include "vision/cars/ground_scale.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

/// From low flights to high ones; the network knows vehicles of three quarters to four thirds of their size, so steps
/// of this leave none out.
constexpr double finest = 0.012;
constexpr double coarsest = 0.17;
constexpr double step = 1.25;
/// Metres from bumper to bumper in the middle of what parks: half is longer, half is shorter.
constexpr double usual_length_m = 4.65;
constexpr double usual_width_m = 1.95;
/// Most surveys are flown so that a pixel is some centimetres; where the vehicles leave a choice that decides.
constexpr double usual_metres = 0.05;
constexpr double spread_of_metres = 0.9;  // of its logarithm
/// Three vehicles that are surely there; with fewer a roof light or a bin may have been taken for one.
constexpr double least_evidence = 1.5;

struct Try {
  double metres_a_pixel = 0.0;
  double evidence = 0.0;  ///< vehicles, each by how surely it is one and how near its size is to the usual one
  double length_m = 0.0;  ///< of the middle one
};

/// Squares of the scaled picture: its middle, and where it is much larger the middles of its quarters, too.
std::vector<cv::Rect> squares(cv::Size const& size) {
  auto const side_of = [](int whole) { return std::min(whole, car_input); };
  std::vector<cv::Rect> all;
  auto const add = [&](double x, double y) {
    int const width = side_of(size.width);
    int const height = side_of(size.height);
    all.emplace_back(std::clamp(static_cast<int>(x * size.width) - width / 2, 0, size.width - width),
                     std::clamp(static_cast<int>(y * size.height) - height / 2, 0, size.height - height), width,
                     height);
  };
  add(0.5, 0.5);
  if (size.width > 3 * car_input / 2 || size.height > 3 * car_input / 2) {
    add(0.25, 0.3);
    add(0.75, 0.7);
  }
  return all;
}

Try tried(cv::Mat const& pixels, double metres_a_pixel, SquareLook const& look) {
  double const scale = metres_a_pixel / car_metres;
  cv::Size const size(std::max(1, static_cast<int>(std::lround(pixels.cols * scale))),
                      std::max(1, static_cast<int>(std::lround(pixels.rows * scale))));
  Try result{.metres_a_pixel = metres_a_pixel};
  std::vector<double> lengths;
  double seen = 0.0;
  for (auto const& square : squares(size)) {
    // Only what is looked at is scaled: at the coarsest scale the whole would be several times as large as the picture.
    cv::Rect const from(static_cast<int>(square.x / scale), static_cast<int>(square.y / scale),
                        static_cast<int>(square.width / scale), static_cast<int>(square.height / scale));
    auto const within = from & cv::Rect(0, 0, pixels.cols, pixels.rows);
    if (within.empty()) continue;
    cv::Mat scaled;
    cv::resize(pixels(within), scaled, square.size(), 0.0, 0.0, scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
    seen += square.area();
    for (auto const& car : look(scaled)) {
      double const length_m = car.box.length * car_metres;
      double const long_off = std::log(length_m / usual_length_m);
      double const wide_off = std::log(car.box.width * car_metres / usual_width_m);
      constexpr double spread = 0.2;
      result.evidence +=
          car.score * car.score * std::exp(-0.5 * (long_off * long_off + wide_off * wide_off) / (spread * spread));
      lengths.push_back(length_m);
    }
  }
  // What was not looked at is taken to be like what was.
  if (seen > 0.0) result.evidence *= std::min(4.0, 1.0 * size.area() / seen);
  double const unusual = std::log(metres_a_pixel / usual_metres) / spread_of_metres;
  result.evidence *= std::exp(-0.5 * unusual * unusual);
  if (!lengths.empty()) {
    std::ranges::nth_element(lengths, lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2));
    result.length_m = lengths[lengths.size() / 2];
  }
  return result;
}

}  // namespace

std::optional<double> metres_a_pixel_by_cars(cv::Mat const& pixels, SquareLook const& look) {
  if (pixels.empty()) return std::nullopt;
  Try best;
  for (double metres = finest; metres <= coarsest; metres *= step) {
    // Of less than this nothing could be told: a car is 46 pixels of the network.
    if (std::max(pixels.cols, pixels.rows) * metres / car_metres < 60.0) continue;
    auto const one = tried(pixels, metres, look);
    if (one.evidence > best.evidence) best = one;
  }
  if (best.evidence < least_evidence) return std::nullopt;
  // Once more where the lengths say that it is: sizes are told best near the usual one.
  auto const nearer = tried(pixels, best.metres_a_pixel * usual_length_m / best.length_m, look);
  if (nearer.evidence > 0.7 * best.evidence) best = nearer;
  return best.metres_a_pixel * usual_length_m / best.length_m;
}

}  // namespace lapwing::vision
