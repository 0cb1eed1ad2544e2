#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "firmware/frames/records.hpp"
#include "geo/transform.hpp"
#include "robot/sensors/attitude.hpp"
#include "robot/sensors/body_filter.hpp"
#include "robot/sensors/imu_watch.hpp"
#include "robot/sensors/sonar.hpp"
#include "robot/sensors/sonar_watch.hpp"
#include "robot/sensors/wheel_odometer.hpp"

namespace lapwing::robot {

/// Where the body was when the board started: x the way it faced then. Drifts against the floor as odometry does.
struct OdometryFrame {};
using OdometryPose = geo::Pose<OdometryFrame>;

/// What the sensors say of the body, at one moment (the seed's SIM).
struct Sensed {
  firmware::Time time{};
  firmware::Time period{};  ///< since the one before

  OdometryPose pose;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of x, y (m²) and yaw (rad²)
  Attitude attitude;                                     ///< yaw is the pose's
  double speed_m_s = 0;                                  ///< ahead positive
  double turn_rad_s = 0;
  double way_m = 0;  ///< gone in all, forwards and backwards
  std::optional<WheelStep> wheels;

  WallDistances walls;
  std::vector<SonarReading> sonars;  ///< each with its place and angle; what is not believed has no range

  struct Faults {
    std::vector<SensorFault> sonars;
    SensorFault imu = SensorFault::none;
    SensorFault encoders = SensorFault::none;
    bool is_slipping = false;

    [[nodiscard]] bool any() const;
  };
  Faults faults;
};

/// Readings into what they say of the body. Pure: the same readings give the same.
///
/// One for each time the board starts: a board that starts anew begins a new odometry frame.
class SensorInterface {
 public:
  explicit SensorInterface(firmware::Description const& description, FilterNoise const& noise = {});

  /// None for the first readings, and where their time does not go on.
  [[nodiscard]] std::optional<Sensed> feed(firmware::Readings const& readings);
  [[nodiscard]] BodyFilter const& filter() const { return filter_; }

 private:
  void move(firmware::Readings const& readings, WheelStep const& wheels, Sensed& sensed);
  void listen(firmware::Readings const& readings, Sensed& sensed);
  [[nodiscard]] SensorFault look_at_wheels(firmware::Readings const& readings, bool has_jumped);

  firmware::Description body_;
  WheelOdometer odometer_;
  BodyFilter filter_;
  ImuWatch imu_watch_;
  std::vector<SonarWatch> sonar_watches_;
  MovedSoFar moved_;
  bool is_level_ = false;
  int standing_ = 0;
  int slipping_ = 0;
};

}  // namespace lapwing::robot
