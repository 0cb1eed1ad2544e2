#pragma once

#include <cmath>

#include <Eigen/Core>

#include "geo/position.hpp"

namespace lapwing::slam {

/// A rigid motion of the plane, or where something stands and looks: metres and radians. The room's kernels work with
/// these three numbers (their derivatives are taken by them); `a_from_c = a_from_b * b_from_c` as with geo::Transform.
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;

  friend bool operator==(Pose2 const&, Pose2 const&) = default;
};

/// One turn of the frame by `yaw`, with sine and cosine taken once.
struct Turn {
  explicit Turn(double yaw) : cosine(std::cos(yaw)), sine(std::sin(yaw)) {}
  [[nodiscard]] Eigen::Vector2d operator*(Eigen::Vector2d const& v) const {
    return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
  }
  [[nodiscard]] Eigen::Vector2d back(Eigen::Vector2d const& v) const {
    return {cosine * v.x() + sine * v.y(), -sine * v.x() + cosine * v.y()};
  }
  double cosine;
  double sine;
};

[[nodiscard]] inline Eigen::Vector2d place(Pose2 const& pose) {
  return {pose.x, pose.y};
}

[[nodiscard]] inline Pose2 operator*(Pose2 const& a, Pose2 const& b) {
  auto const shift = Turn(a.yaw) * place(b);
  return {a.x + shift.x(), a.y + shift.y(), geo::wrap_pi(a.yaw + b.yaw)};
}

/// `from_from_to`: where `to` lies in the frame of `from`.
[[nodiscard]] inline Pose2 between(Pose2 const& from, Pose2 const& to) {
  auto const shift = Turn(from.yaw).back(place(to) - place(from));
  return {shift.x(), shift.y(), geo::wrap_pi(to.yaw - from.yaw)};
}

/// From one pose to the other it goes on evenly, ahead and in turning; `share`: 0 the first, 1 the second.
[[nodiscard]] inline Pose2 on_the_way(Pose2 const& from, Pose2 const& to, double share) {
  auto const step = between(from, to);
  return from * Pose2{share * step.x, share * step.y, share * step.yaw};
}

[[nodiscard]] inline Pose2 inverse(Pose2 const& pose) {
  return between(pose, Pose2{});
}

[[nodiscard]] inline Eigen::Vector3d numbers(Pose2 const& pose) {
  return {pose.x, pose.y, pose.yaw};
}

/// Each number by its own, the angle wrapped: a step of an optimiser.
[[nodiscard]] inline Pose2 stepped(Pose2 const& pose, Eigen::Vector3d const& step) {
  return {pose.x + step.x(), pose.y + step.y(), geo::wrap_pi(pose.yaw + step.z())};
}

[[nodiscard]] inline double distance_m(Pose2 const& a, Pose2 const& b) {
  return (place(a) - place(b)).norm();
}

[[nodiscard]] inline double turn_rad(Pose2 const& a, Pose2 const& b) {
  return std::abs(geo::wrap_pi(a.yaw - b.yaw));
}

}  // namespace lapwing::slam
