#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/async/loop.hpp"
#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "bus/messages/navigation.hpp"
#include "bus/participant/topics.hpp"
#include "robot/platform/body.hpp"
#include "robot/ros/drive_commands.hpp"
#include "robot/ros/ros_laser.hpp"
#include "robot/ros/ros_shown.hpp"
#include "slam/log/pose_track.hpp"

namespace lapwing::robot::ros {

struct RosBodyOptions {
  std::uint32_t domain = 0;
  std::string name_space = {};          ///< "/robot1", before the names of its topics; empty: none
  bool is_local = true;                 ///< its ROS is on this machine
  double radius_m = Limits{}.radius_m;  ///< of a disc around its middle that covers it
};

/// A body that ROS 2 drives (docs/reference/ros.md): a base with wheels and a laser that publish `odom`
/// (nav_msgs/Odometry), `scan` (sensor_msgs/LaserScan) and, if it has one, `battery_state`, and listen to `cmd_vel`
/// (geometry_msgs/Twist or TwistStamped), as a TurtleBot does. Where the laser sits is read from /tf_static.
///
/// A command is sent for each reading, ten times a second. While it stands nothing is sent, so that somebody else may
/// drive it; while it is killed, zero is, again and again. A base that stands by itself when no command comes is up to
/// its driver.
class RosBody final : public Body {
 public:
  /// Errors: those of `bus::Bus::open` and of its topics.
  [[nodiscard]] static base::Result<std::unique_ptr<RosBody>> open(base::Loop& loop, RosBodyOptions const& options,
                                                                   base::Logger log);
  RosBody(RosBody const&) = delete;
  RosBody& operator=(RosBody const&) = delete;
  /// It stands.
  ~RosBody() override;

  void listen(Listener listener) override { listener_ = std::move(listener); }
  [[nodiscard]] slam::Sensor const* sensor() const override { return laser_ ? laser_->sensor() : nullptr; }
  [[nodiscard]] Limits limits() const override { return {.radius_m = options_.radius_m}; }
  [[nodiscard]] std::string link() const override;
  [[nodiscard]] std::optional<std::uint16_t> take_carrier_code() override;
  void drive(Motion motion) override;
  void kill() override;
  void release() override { is_killed_ = false; }
  void show_pose(PoseOnMap const& here) override;
  void show_map(map::OccupancyGrid const& grid) override { shown_->show_map(grid); }
  void show_way(std::vector<Place> const& points) override { shown_->show_way(points); }

 private:
  RosBody(base::Loop& loop, RosBodyOptions const& options, std::unique_ptr<bus::Bus> bus, base::Logger log);
  base::Result<> open_topics();
  void take(bus::Odometry const& odometry);
  void take(bus::BatteryState const& battery);
  void tell_reading();
  void tell_scan();
  void send(Motion motion);
  [[nodiscard]] bool is_driving_unread();
  base::Task<> keep_killed();

  struct Moment {
    std::chrono::nanoseconds stamp{};  ///< by the robot's clock
    slam::Pose2 pose = {};
    double speed_m_s = 0.0;
  };

  base::Loop& loop_;
  RosBodyOptions options_;
  base::Logger log_;
  std::unique_ptr<bus::Bus> bus_;
  std::optional<DriveCommands> commands_;
  std::optional<bus::Subscription<bus::Odometry>> odometry_;
  std::optional<bus::Subscription<bus::BatteryState>> batteries_;
  std::unique_ptr<RosLaser> laser_;
  std::unique_ptr<RosShown> shown_;
  Listener listener_;

  slam::PoseTrack track_;  ///< of the last seconds
  std::optional<Moment> now_;
  std::optional<double> battery_;
  bool is_told_in_percent_ = false;
  std::optional<RosLaser::Seen> waiting_;  ///< a scan that odometry has not caught up with
  explore::SideDistances sides_{.left_m = 5.0, .front_m = 7.5, .right_m = 5.0};
  base::TimePoint told_at_{};
  base::TimePoint carrier_told_{};  ///< of which reading the carrier's code was told last
  int stood_ = 0;                   ///< zeros that were sent since it drove
  std::string base_frame_;
  bool is_driving_ = false;
  std::optional<base::TimePoint> unread_since_;  ///< while it drives: nobody listens to its commands
  bool is_killed_ = false;
  base::Scope scope_;
};

}  // namespace lapwing::robot::ros
