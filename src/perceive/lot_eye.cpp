#include "perceive/lot_eye.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "explore/lot/lot_map.hpp"
#include "perceive/ground_picture.hpp"
#include "vision/cars/contrast_cars.hpp"
#include "vision/lot/occupancy.hpp"
#include "vision/lot/seen_slots.hpp"

namespace lapwing::perceive {

namespace {

/// Cars that are less sure say nothing of a slot.
constexpr double least_car = 0.15;
/// What lies nearer to the edge of the picture may be cut off.
constexpr double clear_m = 0.25;

explore::Corners on_ground(GroundPicture const& ground, auto const& corners) {
  explore::Corners outline;
  for (std::size_t k = 0; k < outline.size(); ++k)
    outline[k] = ground.ground({corners[k].x * ground.metres_a_pixel, corners[k].y * ground.metres_a_pixel});
  return outline;
}

/// All of it was really in the picture: the plan of the ground is larger where the drone leans.
bool is_seen(explore::Corners const& outline, geo::GroundView const& view) {
  auto const sampling = geo::ground_sampling(view, view.lens.middle);
  double const clear_px = sampling ? clear_m / sampling->coarsest_m : 0.0;
  return std::ranges::all_of(outline, [&](auto const& corner) {
    auto const pixel = geo::seen_at(view, corner);
    return pixel && pixel->x >= clear_px && pixel->y >= clear_px && pixel->x <= view.lens.width_px - clear_px &&
           pixel->y <= view.lens.height_px - clear_px;
  });
}

/// What of the plan the camera shows; where the drone leans the plan is larger.
vision::SeenGround shown_ground(GroundPicture const& ground, geo::GroundView const& view,
                                explore::LotSettings const& settings) {
  auto const seen = explore::well_seen_ground(view, settings);
  std::vector<cv::Point2d> outline;
  for (auto const& place : seen.rings.front()) {
    Eigen::Vector2d const from_corner = place.v - ground.corner.v;
    outline.emplace_back(from_corner.dot(ground.right), from_corner.dot(ground.down));
  }
  return vision::SeenGround(outline);
}

/// Where vehicles are, those that the picture's edge cuts off, too.
cv::Mat standing_on(GroundPicture const& ground, vision::Overhead const& seen) {
  constexpr double on = 255.0;
  constexpr double likely = 0.2;
  cv::Mat standing = cv::Mat::zeros(ground.pixels.size(), CV_8U);
  if (!seen.covered.empty()) {
    cv::Mat const covered = seen.covered > likely;
    cv::resize(covered, standing, standing.size(), 0.0, 0.0, cv::INTER_NEAREST);
  }
  for (auto const& car : seen.cars) {
    std::vector<cv::Point> outline;
    for (auto const& corner : vision::corners_of(car.box)) outline.push_back(cv::Point2d(corner.x, corner.y));
    cv::fillConvexPoly(standing, outline, cv::Scalar(on));
  }
  return standing;
}

}  // namespace

base::Result<LotEye> LotEye::make(std::string const& network, explore::LotSettings settings) {
  LotEye eye(std::move(settings));
  if (network.empty()) return eye;
  auto loaded = vision::CarNetwork::load(network);
  if (!loaded) return std::unexpected(loaded.error());
  eye.network_.emplace(*std::move(loaded));
  return eye;
}

vision::Overhead LotEye::vehicles(cv::Mat const& pixels, double metres_a_pixel) {
  if (network_) return network_->look(pixels, metres_a_pixel, least_car);
  vision::Overhead seen;
  seen.cars = vision::cars_by_contrast(pixels, metres_a_pixel);
  std::erase_if(seen.cars, [](auto const& car) { return car.score < least_car; });
  return seen;
}

std::optional<explore::LotSight> LotEye::look(cv::Mat const& picture, geo::GroundView const& view, base::UtcTime at) {
  auto const ground = ground_picture(picture, view, settings_);
  if (!ground) return std::nullopt;
  explore::LotSight sight{.vehicle = {}, .at = at, .view = view};
  auto const seen = vehicles(ground->pixels, ground->metres_a_pixel);
  auto const shown = shown_ground(*ground, view, settings_);
  for (auto const& slot : vision::slots_seen(ground->pixels, seen.cars, ground->metres_a_pixel, shown)) {
    auto const outline = on_ground(*ground, slot.corners);
    if (!is_seen(outline, view)) continue;
    sight.slots.push_back({.outline = outline,
                           .surety = slot.surety,
                           .taken_chance = vision::occupied_chance(slot.corners, seen, ground->pixels.size())});
  }
  for (auto const& car : seen.cars) {
    auto const outline = on_ground(*ground, vision::corners_of(car.box));
    if (is_seen(outline, view)) sight.cars.push_back({.outline = outline, .chance = car.score});
  }
  if (ties_) ties_->tie(sight, *ground, explore::well_seen_ground(view, settings_), standing_on(*ground, seen));
  return sight;
}

std::optional<std::string> picture_fault(cv::Mat const& picture) {
  if (picture.empty()) return "it is empty";
  cv::Mat small;
  cv::resize(picture, small, {64, 36}, 0.0, 0.0, cv::INTER_AREA);
  cv::Mat shades;
  cv::cvtColor(small, shades, cv::COLOR_BGR2GRAY);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(shades, mean, deviation);
  constexpr double black = 12.0;
  constexpr double white = 250.0;
  constexpr double flat = 1.0;
  if (mean[0] < black) return "it is black: is the lens covered?";
  if (mean[0] > white) return "it is white: the light is too bright for the camera";
  if (deviation[0] < flat) return "it has one colour alone";
  return std::nullopt;
}

}  // namespace lapwing::perceive
