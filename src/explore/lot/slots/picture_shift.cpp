#include "explore/lot/slots/picture_shift.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/LU>

namespace lapwing::explore {

Eigen::Matrix<double, 2, 4> shift_of_place(Eigen::Vector2d const& from_below) {
  Eigen::Matrix<double, 2, 4> parts;
  parts << 1.0, 0.0, -from_below.y(), from_below.x(),  //
      0.0, 1.0, from_below.x(), from_below.y();
  return parts;
}

map::SitePoint PictureShift::of(map::SitePoint const& place, map::SitePoint const& below) const {
  return map::SitePoint(Eigen::Vector2d(place.v + shift_of_place(place.v - below.v) * v));
}

map::SitePoint below_camera(LotSight const& sight) {
  auto const camera = sight.view.site_from_camera.origin();
  return {camera.x(), camera.y()};
}

LotSight shifted(LotSight sight, PictureShift const& shift) {
  auto const below = below_camera(sight);
  auto const shift_all = [&](Corners& corners) {
    for (auto& corner : corners) corner = shift.of(corner, below);
  };
  for (auto& slot : sight.slots) shift_all(slot.outline);
  for (auto& car : sight.cars) shift_all(car.outline);
  for (auto& tie : sight.tie_points) tie.here = shift.of(tie.here, below);
  auto& view = sight.view;
  auto const at = view.site_from_camera.origin();
  Eigen::Quaterniond const turn(Eigen::AngleAxisd(shift.v[2], Eigen::Vector3d::UnitZ()));
  view.site_from_camera =
      geo::CameraPlace({at.x() + shift.v[0], at.y() + shift.v[1], at.z() + shift.v[3] * view.height_m()},
                       turn * view.site_from_camera.rotation());
  return sight;
}

Eigen::Vector4d expected_shift(LotSight const& sight) {
  double const height_m = std::max(sight.view.height_m(), 0.1);
  double const level_m = std::hypot(sight.doubt.position_m, sight.doubt.angle_rad * height_m);
  return {level_m, level_m, sight.doubt.heading_rad, sight.doubt.height_m / height_m};
}

double huber_share(double sigmas) {
  constexpr double from_sigmas = 2.0;
  return sigmas <= from_sigmas ? 1.0 : from_sigmas / sigmas;
}

FittedShift fitted_shift(LotSight const& sight, std::span<Tie const> ties) {
  auto const below = below_camera(sight);
  Eigen::Vector4d const expected = expected_shift(sight);
  FittedShift fit{.shift = {}, .sigma = expected};
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix4d normal = expected.cwiseAbs2().cwiseInverse().asDiagonal();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (auto const& tie : ties) {
      auto const parts = shift_of_place(tie.in_picture.v - below.v);
      double const left_m = geo::distance_m(tie.on_map, fit.shift.of(tie.in_picture, below));
      double const weight = huber_share(left_m / tie.sigma_m) / (tie.sigma_m * tie.sigma_m);
      normal += weight * parts.transpose() * parts;
      right += weight * parts.transpose() * (tie.on_map.v - tie.in_picture.v);
    }
    Eigen::Matrix4d const left = normal.inverse();
    fit.shift.v = left * right;
    fit.sigma = left.diagonal().cwiseSqrt();
  }
  return fit;
}

}  // namespace lapwing::explore
