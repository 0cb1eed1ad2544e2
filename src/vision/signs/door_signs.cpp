#include "vision/signs/door_signs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

/// The wall that is seen on each side, in widths of the door: plates hang at its handle's side, within reach.
constexpr double beside = 0.7;
/// Signs are beside doors and seldom above them; what is below the knee is floor.
constexpr double above = 0.12;
constexpr double least_side = 32.0;
constexpr double longest_side = 1200.0;

double distance(Point const& a, Point const& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

cv::Point2f mapped(cv::Matx33d const& by, double x, double y) {
  auto const at = by * cv::Vec3d(x, y, 1.0);
  return {static_cast<float>(at[0] / at[2]), static_cast<float>(at[1] / at[2])};
}

}  // namespace

DoorView view_of_door(cv::Mat const& pixels, Detection const& door) {
  if (!door.corners || pixels.empty()) return {};
  auto const& c = *door.corners;
  double const width = std::max(distance(c[0], c[1]), distance(c[3], c[2]));
  double const height = std::max(distance(c[0], c[3]), distance(c[1], c[2]));
  double const shrink = std::min(1.0, longest_side / std::max({(1.0 + 2.0 * beside) * width, height, 1.0}));
  cv::Size const size(static_cast<int>((1.0 + 2.0 * beside) * width * shrink),
                      static_cast<int>((1.0 + above) * height * shrink));
  if (std::min(size.width, size.height) < least_side) return {};
  std::array<cv::Point2f, 4> seen;
  std::ranges::transform(c, seen.begin(),
                         [](Point const& p) { return cv::Point2f(static_cast<float>(p.x), static_cast<float>(p.y)); });
  auto const left = static_cast<float>(beside * width * shrink);
  auto const right = static_cast<float>((1.0 + beside) * width * shrink);
  auto const top = static_cast<float>(above * height * shrink);
  auto const bottom = static_cast<float>(size.height);
  std::array<cv::Point2f, 4> const goal{cv::Point2f(left, top), cv::Point2f(right, top), cv::Point2f(right, bottom),
                                        cv::Point2f(left, bottom)};
  cv::Matx33d const there = cv::getPerspectiveTransform(seen.data(), goal.data());
  DoorView view{.pixels = {}, .to_picture = there.inv()};
  cv::warpPerspective(pixels, view.pixels, there, size, cv::INTER_AREA, cv::BORDER_REPLICATE);
  return view;
}

std::vector<Detection> signs_of_door(SignFinder& signs, cv::Mat const& pixels, Detection const& door) {
  auto const view = view_of_door(pixels, door);
  if (view.pixels.empty()) return {};
  std::vector<Detection> found;
  for (auto& sign : signs.find(view.pixels)) {
    auto const& box = sign.box;
    std::array<cv::Point2f, 4> const at{mapped(view.to_picture, box.x, box.y),
                                        mapped(view.to_picture, box.x + box.width, box.y),
                                        mapped(view.to_picture, box.x + box.width, box.y + box.height),
                                        mapped(view.to_picture, box.x, box.y + box.height)};
    auto const [x0, x1] = std::ranges::minmax(at, {}, &cv::Point2f::x);
    auto const [y0, y1] = std::ranges::minmax(at, {}, &cv::Point2f::y);
    double const left = std::clamp<double>(x0.x, 0.0, pixels.cols);
    double const top = std::clamp<double>(y0.y, 0.0, pixels.rows);
    sign.box = {.x = left,
                .y = top,
                .width = std::clamp<double>(x1.x, 0.0, pixels.cols) - left,
                .height = std::clamp<double>(y1.y, 0.0, pixels.rows) - top};
    if (sign.corners) {
      for (auto& corner : *sign.corners) {
        auto const there = mapped(view.to_picture, corner.x, corner.y);
        corner = {there.x, there.y};
      }
    }
    // What lies beyond the picture is its edge, repeated.
    if (sign.box.area() > 0.0) found.push_back(std::move(sign));
  }
  return found;
}

}  // namespace lapwing::vision
