// What a robot shows of itself: in the registry, and to who asks for its pose and its way.
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "robot/platform/robot.hpp"
#include "robot/platform/robot_display.hpp"

namespace lapwing::robot {

void Robot::show_reading(Reading const& reading, bool is_first) {
  auto const now = around_.loop.now();
  auto& state = around_.registry.edit(id());
  if (is_first) {
    state.name = spec_.name;
    state.family = vehicle::Family::robot;
    state.payload.names = spec_.payload;
    state.links.used = body_->link();
    state.mode.set("HOLD", now);
  }
  RobotMoment moment{.reading = reading, .asked = asked_, .stands = stands(), .driven_m = driven_m_};
  if (here_) {
    auto const pose = pose_now(reading.odometry);
    body_->show_pose({.pose = pose, .covariance = here_->covariance, .odometry = reading.odometry});
    auto const at = on_site({pose.x, pose.y});
    moment.pose = vehicle::SitePose{.site = spec_.site,
                                    .floor = spec_.floor,
                                    .position = geo::Point3<geo::SiteFrame>(at.x(), at.y(), 0.0),
                                    .yaw_rad = geo::wrap_pi(pose.yaw + site_from_map_.yaw_rad())};
    moment.place = around_.on_globe(at);
  }
  show(moment, now, state);
  if (is_first) {
    around_.registry.touch_membership(id());
  } else {
    around_.registry.touch(id());
  }
}

std::optional<slam::Pose2> Robot::pose() const {
  if (!here_ || !last_reading_) return std::nullopt;
  return pose_now(last_reading_->odometry);
}

std::optional<PoseSpread> Robot::spread() const {
  if (!here_) return std::nullopt;
  Eigen::Matrix2d const turn = Eigen::Rotation2Dd(site_from_map_.yaw_rad()).toRotationMatrix();
  Eigen::Matrix2d const covariance = turn * here_->covariance.topLeftCorner<2, 2>() * turn.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> const axes(covariance);
  Eigen::Vector2d const deviations = axes.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  Eigen::Vector2d const major = axes.eigenvectors().col(1);
  return PoseSpread{.major_m = deviations(1),
                    .minor_m = deviations(0),
                    .axis_rad = std::atan2(major.y(), major.x()),
                    .yaw_rad = std::sqrt(std::max(0.0, here_->covariance(2, 2)))};
}

std::optional<Companion> Robot::as_companion() const {
  bool const is_about_something = is_driving() && is_under_way() && !std::holds_alternative<std::monostate>(errand_);
  if (!is_about_something || !here_ || !grid_) return std::nullopt;
  return Companion{.id = spec_.id,
                   .grid = *grid_,
                   .pose = here_->pose,
                   .intent = plan_.intent,
                   .waits = plan_.waits,
                   .explores = std::holds_alternative<ExploreErrand>(errand_)};
}

std::vector<geo::Point<geo::SiteFrame>> Robot::way() const {
  std::vector<geo::Point<geo::SiteFrame>> way;
  constexpr std::size_t every = 5;  // a point a quarter of a metre is as much as anybody sees
  auto const& points = plan_.way.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i % every == 0 || i + 1 == points.size()) way.push_back(on_site(points[i]));
  return way;
}

}  // namespace lapwing::robot
