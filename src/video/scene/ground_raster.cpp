#include "video/scene/ground_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "video/scene/ground_surface.hpp"
#include "video/scene/vehicle_solid.hpp"

namespace lapwing::video {

namespace {

constexpr int level_count = 5;
constexpr int coarsest = 1 << (level_count - 1);
/// How far the drawn ground goes on beyond all that is listed.
constexpr double margin_m = 30.0;
/// OpenCV samples from no larger ones.
constexpr double longest_side_px = 20'000.0;

struct Extent {
  double west = std::numeric_limits<double>::max();
  double south = std::numeric_limits<double>::max();
  double east = std::numeric_limits<double>::lowest();
  double north = std::numeric_limits<double>::lowest();

  void add(Spot const& place) {
    west = std::min(west, place.x());
    east = std::max(east, place.x());
    south = std::min(south, place.y());
    north = std::max(north, place.y());
  }
};

Extent extent_of(CarPark const& park) {
  Extent extent;
  for (auto const& patch : park.patches)
    for (auto const& corner : patch.corners) extent.add(corner);
  for (auto const& slot : park.slots)
    for (auto const& corner : slot.outline) extent.add(corner);
  for (auto const& stripe : park.stripes)
    for (auto const& point : stripe.points) extent.add(point);
  for (auto const& block : park.blocks)
    for (auto const& corner : block.corners) extent.add(corner);
  for (auto const& tree : park.trees) extent.add(tree.at);
  if (park.picture) {
    extent.add(park.picture->south_west);
    extent.add(park.picture->north_east);
  }
  if (extent.west > extent.east) extent.add(Spot());
  return extent;
}

RasterFrame frame_of(CarPark const& park) {
  auto const extent = extent_of(park);
  double const width_m = extent.east - extent.west + 2.0 * margin_m;
  double const height_m = extent.north - extent.south + 2.0 * margin_m;
  double const pixel_m = std::max({park.pixel_m, std::sqrt(width_m * height_m / most_ground_pixels),
                                   std::max(width_m, height_m) / longest_side_px});
  auto const side = [&](double metres) {
    return coarsest * std::max(1, static_cast<int>(std::ceil(metres / pixel_m / coarsest)));
  };
  return {.north_west = Spot(extent.west - margin_m, extent.north + margin_m),
          .pixel_m = pixel_m,
          .size = {side(width_m), side(height_m)}};
}

void put_photograph(cv::Mat& ground, GroundPicture const& picture, RasterFrame const& frame,
                    cv::Mat const& photograph) {
  auto const low = frame.pixel(Spot(picture.south_west.x(), picture.north_east.y()));
  auto const high = frame.pixel(Spot(picture.north_east.x(), picture.south_west.y()));
  cv::Rect const box(cv::Point(cvRound(low.x), cvRound(low.y)), cv::Point(cvRound(high.x), cvRound(high.y)));
  auto const seen = box & cv::Rect({}, ground.size());
  if (seen.empty() || seen != box) return;
  cv::resize(photograph, ground(box), box.size(), 0.0, 0.0,
             photograph.cols > box.width ? cv::INTER_AREA : cv::INTER_LINEAR);
}

/// The shadows of what never moves, in pixels `scale` times as large.
cv::Mat shade_of(CarPark const& park, RasterFrame const& frame, Sun const& sun, int scale) {
  cv::Mat shade = cv::Mat::zeros(frame.size / scale, CV_8U);
  auto const pixel = [&](Eigen::Vector3d const& place) { return frame.pixel(Spot(place.x(), place.y())) / scale; };
  for (auto const& block : park.blocks)
    for (std::size_t i = 0; i < block.corners.size(); ++i) {
      auto const& a = block.corners[i].v;
      auto const& b = block.corners[(i + 1) % block.corners.size()].v;
      fill_mask(shade, {pixel({a.x(), a.y(), 0.0}), pixel({b.x(), b.y(), 0.0}),
                        pixel(sun.shadow_of({b.x(), b.y(), block.height_m})),
                        pixel(sun.shadow_of({a.x(), a.y(), block.height_m}))});
    }
  for (auto const& block : park.blocks) {
    std::vector<cv::Point2d> roof;
    for (auto const& corner : block.corners)
      roof.push_back(pixel(sun.shadow_of({corner.x(), corner.y(), block.height_m})));
    fill_mask(shade, roof);
  }
  for (auto const& tree : park.trees) {
    auto const middle = pixel(sun.shadow_of({tree.at.x(), tree.at.y(), 0.8 * tree.height_m}));
    cv::circle(shade, middle, std::max(1, cvRound(0.95 * tree.radius_m / frame.pixel_m / scale)), 235.0, cv::FILLED);
  }
  constexpr double soft_m = 0.12;
  cv::GaussianBlur(shade, shade, {}, std::max(0.5, soft_m / frame.pixel_m / scale));
  return shade;
}

void darken(cv::Mat& ground, cv::Mat const& shade, int scale, Sun const& sun) {
  // A strip at a time: the shade of all of it in full size would be as large as the ground.
  constexpr int strip = 16;
  std::array<double, 256> left = {};
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = sun.in_shadow(static_cast<double>(i) / 255.0);
  for (int y = 0; y < ground.rows; y += strip * scale) {
    cv::Rect const rows(0, y / scale, shade.cols, std::min(strip, shade.rows - y / scale));
    if (cv::countNonZero(shade(rows)) == 0) continue;
    cv::Mat large;
    cv::resize(shade(rows), large, {ground.cols, rows.height * scale}, 0.0, 0.0, cv::INTER_LINEAR);
    for (int k = 0; k < large.rows; ++k)
      for (int x = 0; x < ground.cols; ++x)
        if (auto const dark = large.at<std::uint8_t>(k, x); dark != 0) ground.at<cv::Vec3b>(y + k, x) *= left[dark];
  }
}

/// The border runs out into the colour of what lies beyond, so that no edge is seen.
void fade_out(cv::Mat& ground, double pixel_m, cv::Scalar const& beyond) {
  constexpr double fade_m = 15.0;
  double const reach = fade_m / pixel_m;
  for (int y = 0; y < ground.rows; ++y)
    for (int x = 0; x < ground.cols; ++x) {
      int const in = std::min({x, y, ground.cols - 1 - x, ground.rows - 1 - y});
      if (in >= reach) {
        x = std::max(x, ground.cols - 1 - in);  // the inner part of a row
        continue;
      }
      double const share = in / reach;
      auto& pixel = ground.at<cv::Vec3b>(y, x);
      for (int channel = 0; channel < 3; ++channel)
        pixel[channel] = cv::saturate_cast<std::uint8_t>(beyond[channel] + share * (pixel[channel] - beyond[channel]));
    }
}

}  // namespace

double GroundRaster::shade_at(Spot const& place) const {
  double const scale = pixel_m * static_cast<double>(levels.front().cols) / shade.cols;
  cv::Point const pixel(static_cast<int>((place.x() - north_west.x()) / scale),
                        static_cast<int>((north_west.y() - place.y()) / scale));
  return cv::Rect({}, shade.size()).contains(pixel) ? shade.at<std::uint8_t>(pixel) / 255.0 : 0.0;
}

GroundRaster draw_ground(CarPark const& park, Sun const& sun, cv::Mat const& photograph) {
  auto const frame = frame_of(park);
  GroundRaster raster{.levels = {}, .shade = {}, .pixel_m = frame.pixel_m, .north_west = frame.north_west};
  raster.beyond = mean_grass() * sun.brightness;
  cv::Mat ground;
  {
    auto const cloudy = clouds(frame.size, frame.pixel_m, park.seed);
    auto const fine = grain(park.seed);
    ground = draw_surface(park, frame, cloudy, fine);
    if (park.picture && !photograph.empty()) put_photograph(ground, *park.picture, frame, photograph);
    draw_paint(ground, park, frame, cloudy, fine);
  }
  ground.convertTo(ground, -1, sun.brightness);
  constexpr int shade_scale = 2;
  raster.shade = shade_of(park, frame, sun, shade_scale);
  darken(ground, raster.shade, shade_scale, sun);
  fade_out(ground, frame.pixel_m, raster.beyond);
  raster.levels.push_back(ground);
  for (int level = 1; level < level_count; ++level) {
    cv::Mat half;
    cv::resize(raster.levels.back(), half, raster.levels.back().size() / 2, 0.0, 0.0, cv::INTER_AREA);
    raster.levels.push_back(half);
  }
  return raster;
}

}  // namespace lapwing::video
