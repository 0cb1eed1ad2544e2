#pragma once

#include <cmath>

#include <Eigen/Geometry>

#include "geo/point.hpp"
#include "geo/position.hpp"

namespace lapwing::geo {

/// Where frame `From` lies in frame `To`, as a rigid motion: turns what is given in `From` into what it is in `To`.
///
/// Named after both, so that neighbours cancel: `map_from_body * body_from_lidar * hit`. The wrong order does not
/// compile. Angles are radians, counterclockwise positive (REP 103); in three dimensions rotations are quaternions.
template <class To, class From, int dim = 2>
class Transform {
 public:
  using Motion = Eigen::Transform<double, dim, Eigen::Isometry>;

  /// The frames coincide.
  Transform() : motion_(Motion::Identity()) {}
  /// `origin`: that of `From`, in `To`; `yaw_rad`: of the x axis of `From`, in `To`.
  Transform(Point<To, dim> const& origin, double yaw_rad)
    requires(dim == 2)
      : motion_(Eigen::Translation2d(origin.v) * Eigen::Rotation2Dd(yaw_rad)) {}
  /// `rotation` is made a unit quaternion. Precondition: it is not zero.
  Transform(Point<To, dim> const& origin, Eigen::Quaterniond const& rotation)
    requires(dim == 3)
      : motion_(Eigen::Translation3d(origin.v) * rotation.normalized()) {}

  /// Of the frame `From`, in `To`.
  [[nodiscard]] Point<To, dim> origin() const {
    return Point<To, dim>(typename Point<To, dim>::Numbers(motion_.translation()));
  }
  /// Of the x axis of `From` in the x-y plane of `To`, in [-pi, pi].
  [[nodiscard]] double yaw_rad() const { return std::atan2(motion_.linear()(1, 0), motion_.linear()(0, 0)); }
  [[nodiscard]] Eigen::Quaterniond rotation() const
    requires(dim == 3)
  {
    return Eigen::Quaterniond(motion_.linear());
  }
  [[nodiscard]] Transform<From, To, dim> inverse() const { return Transform<From, To, dim>(motion_.inverse()); }

  template <class Inner>
  [[nodiscard]] Transform<To, Inner, dim> operator*(Transform<From, Inner, dim> const& inner) const {
    return Transform<To, Inner, dim>(Motion(motion_ * inner.motion_));
  }
  [[nodiscard]] Point<To, dim> operator*(Point<From, dim> const& place) const {
    return Point<To, dim>(typename Point<To, dim>::Numbers(motion_ * place.v));
  }
  /// Shifts are turned, not moved.
  [[nodiscard]] Vector<To, dim> operator*(Vector<From, dim> const& shift) const {
    return Vector<To, dim>(typename Vector<To, dim>::Numbers(motion_.linear() * shift.v));
  }

 private:
  template <class, class, int>
  friend class Transform;
  explicit Transform(Motion const& motion) : motion_(motion) {}

  Motion motion_;
};

template <class To, class From>
using Transform3 = Transform<To, From, 3>;

/// Where something stands and looks on the level plane of a frame.
template <class Frame>
struct Pose {
  Point<Frame> position;
  double yaw_rad = 0.0;  ///< counterclockwise from the frame's x axis

  /// As the place of the body's own frame: `pose.frame<Body>()` is `frame_from_body`.
  template <class Body>
  [[nodiscard]] Transform<Frame, Body> frame() const {
    return {position, yaw_rad};
  }
  friend bool operator==(Pose const&, Pose const&) = default;
};

template <class To, class From>
[[nodiscard]] Pose<From> pose_of(Transform<From, To> const& frame) {
  return {frame.origin(), frame.yaw_rad()};
}

template <class To, class From>
[[nodiscard]] Pose<To> operator*(Transform<To, From> const& to_from, Pose<From> const& pose) {
  return {to_from * pose.position, wrap_pi(to_from.yaw_rad() + pose.yaw_rad)};
}

/// Between two poses, `share` 0 at a and 1 at b: straight, and turning the shorter way.
template <class Frame>
[[nodiscard]] Pose<Frame> between(Pose<Frame> const& a, Pose<Frame> const& b, double share) {
  return {a.position + share * (b.position - a.position), wrap_pi(a.yaw_rad + share * wrap_pi(b.yaw_rad - a.yaw_rad))};
}

}  // namespace lapwing::geo
