#include "vision/lot/occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

/// Chosen by hand so that a found vehicle that covers its slot is near 1; `training/cars/train.py occupancy` fits them.
constexpr double offset = -5.0;
constexpr double of_covered = 8.0;
constexpr double of_best = 3.0;
/// Where no network looked: what a found vehicle, and none, are worth. Not fitted.
constexpr double with_car = 0.85;
constexpr double without_car = 0.2;

/// A place of the slot: both shares from 0 to 1, from its first corner.
cv::Point2d at(std::array<cv::Point2d, 4> const& slot, double wide, double deep) {
  auto const mouth = slot[0] + wide * (slot[1] - slot[0]);
  auto const head = slot[3] + wide * (slot[2] - slot[3]);
  return mouth + deep * (head - mouth);
}

/// What the middle of the slot shows, on a grid; paint and neighbours are at its sides.
struct Core {
  double covered = 0.0;     ///< 0 to 1
  double in_picture = 0.0;  ///< share of it
};

Core core_of(std::array<cv::Point2d, 4> const& slot, Overhead const& seen, cv::Size const& picture) {
  constexpr int tries = 9;
  constexpr double margin = 0.15;
  Core core;
  for (int row = 0; row < tries; ++row) {
    for (int column = 0; column < tries; ++column) {
      auto const share = [](int k) { return margin + (1.0 - 2.0 * margin) * k / (tries - 1); };
      auto const place = at(slot, share(column), share(row));
      if (place.x < 0.0 || place.y < 0.0 || place.x >= picture.width || place.y >= picture.height) continue;
      core.in_picture += 1.0;
      if (seen.covered.empty()) continue;
      int const x = std::min(static_cast<int>(place.x * seen.covered_scale), seen.covered.cols - 1);
      int const y = std::min(static_cast<int>(place.y * seen.covered_scale), seen.covered.rows - 1);
      core.covered += seen.covered.at<float>(y, x);
    }
  }
  if (core.in_picture > 0.0) core.covered /= core.in_picture;
  core.in_picture /= tries * tries;
  return core;
}

double best_inside(std::array<cv::Point2d, 4> const& slot, Overhead const& seen) {
  std::vector<cv::Point2f> outline;
  for (auto const& corner : slot) outline.emplace_back(static_cast<float>(corner.x), static_cast<float>(corner.y));
  double best = 0.0;
  for (auto const& car : seen.cars) {
    cv::Point2f const middle(static_cast<float>(car.box.middle.x), static_cast<float>(car.box.middle.y));
    constexpr bool with_distance = false;
    if (cv::pointPolygonTest(outline, middle, with_distance) >= 0.0) best = std::max(best, car.score);
  }
  return best;
}

}  // namespace

std::optional<double> occupied_chance(std::array<cv::Point2d, 4> const& slot, Overhead const& seen,
                                      cv::Size const& picture) {
  auto const core = core_of(slot, seen, picture);
  constexpr double least_in_picture = 0.7;
  if (core.in_picture < least_in_picture) return std::nullopt;
  double const best = best_inside(slot, seen);
  if (seen.covered.empty()) return best > 0.0 ? with_car : without_car;
  return 1.0 / (1.0 + std::exp(-(offset + of_covered * core.covered + of_best * best)));
}

}  // namespace lapwing::vision
