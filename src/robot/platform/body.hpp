#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "base/time.hpp"
#include "explore/strategy/strategy.hpp"
#include "map/grid/occupancy_grid.hpp"
#include "robot/planner/way.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// What wheels, inertial sensors and sonars say together, ten times a second.
struct Reading {
  base::TimePoint at{};
  slam::Pose2 odometry = {};  ///< in a frame that drifts
  double speed_m_s = 0.0;
  std::optional<double> battery = {};  ///< 0..1
  explore::SideDistances sides = {};
  bool is_killed = false;          ///< it stands until it is released
  bool is_too_near = false;        ///< something is nearer than its safe distance: it backs away from that
  bool is_waiting = false;         ///< its watchdog stands it still: no command has come lately
  std::uint16_t sensors_code = 0;  ///< what is wrong with the sensors, of watch/codes.hpp
};

/// Where a robot is on its map.
struct PoseOnMap {
  slam::Pose2 pose = {};
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y and yaw along the map's axes, in m^2 and rad^2
  slam::Pose2 odometry = {};                             ///< where its body says that it is
};

/// A robot's hardware as the platform sees it, whatever link leads to it: readings and scans in, motions out.
/// Thread-bound; calls its listeners on the loop, never from within one of its own functions.
class Body {
 public:
  virtual ~Body() = default;
  Body() = default;
  Body(Body const&) = delete;
  Body& operator=(Body const&) = delete;

  struct Listener {
    std::function<void(Reading const&)> on_reading = {};
    std::function<void(slam::Scan const&)> on_scan = {};
  };
  virtual void listen(Listener listener) = 0;
  /// What it maps by: its laser or, without one, its sonars or single rangers. Null until it has said so; scans come
  /// only afterwards.
  [[nodiscard]] virtual slam::Sensor const* sensor() const = 0;
  /// How large it is and what it can do; to be asked when the sensor is known.
  [[nodiscard]] virtual Limits limits() const = 0;
  /// Over what it is reached, for people.
  [[nodiscard]] virtual std::string link() const = 0;

  /// What is wrong with what drives it, of watch/codes.hpp; nothing while nothing new was heard of it. Asked ten times
  /// a second by who watches it.
  [[nodiscard]] virtual std::optional<std::uint16_t> take_carrier_code() = 0;

  /// Goes on like this until told otherwise; a body that hears nothing for half a second stands still by itself.
  virtual void drive(Motion motion) = 0;
  /// Stands at once, whatever it is told, until `release`.
  virtual void kill() = 0;
  virtual void release() = 0;

  // ---- what the robot has made of it all, for those who look on at the body's own end; most have nobody there

  /// With each reading, once it has a place.
  virtual void show_pose(PoseOnMap const& /*here*/) {}
  /// When it has changed, twice a second at most.
  virtual void show_map(map::OccupancyGrid const& /*grid*/) {}
  /// Empty: it follows none.
  virtual void show_way(std::vector<Place> const& /*points*/) {}
};

}  // namespace lapwing::robot
