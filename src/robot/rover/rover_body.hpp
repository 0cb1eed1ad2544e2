#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "base/async/loop.hpp"
#include "base/async/scope.hpp"
#include "base/clock_offset.hpp"
#include "base/log.hpp"
#include "link/byte_link.hpp"
#include "mavlink/connection/connection.hpp"
#include "robot/platform/body.hpp"
#include "robot/ros/ros_laser.hpp"
#include "robot/rover/laser_on_ros.hpp"
#include "robot/rover/rover_helm.hpp"
#include "robot/rover/rover_ranges.hpp"
#include "robot/rover/rover_track.hpp"

namespace lapwing::robot::rover {

struct RoverBodyOptions {
  std::uint8_t system_id = 1;
  /// Where its estimator's origin is put when nothing else gives it one; nothing: nowhere.
  std::optional<geo::Wgs84> origin = std::nullopt;
  HelmTimes helm = {};
  double radius_m = Limits{}.radius_m;  ///< of a disc around its middle that covers it
};

/// A body whose carrier is a MAVLink rover: ArduPilot's, skid-steered (docs/reference/mavlink-rover.md).
///
/// It is driven in GUIDED by SET_POSITION_TARGET_LOCAL_NED, a speed ahead and a turn rate, ten times a second; where it
/// is comes from LOCAL_POSITION_NED and ATTITUDE, ranges from OBSTACLE_DISTANCE or DISTANCE_SENSOR, or from a laser on
/// ROS 2. A command that is not renewed for half a second becomes a stop here; when this program falls silent, the
/// autopilot stops after three seconds by itself.
class RoverBody final : public Body {
 public:
  /// The loop outlives it.
  RoverBody(base::Loop& loop, std::unique_ptr<link::ByteLink> link, RoverBodyOptions const& options, base::Logger log);
  RoverBody(RoverBody const&) = delete;
  RoverBody& operator=(RoverBody const&) = delete;
  /// It stands.
  ~RoverBody() override;

  /// Ranges from there alone. Errors: those of `bus::Bus::open` and of its topics.
  [[nodiscard]] base::Result<> use(LaserOnRos const& laser);

  void listen(Listener listener) override { listener_ = std::move(listener); }
  [[nodiscard]] slam::Sensor const* sensor() const override;
  [[nodiscard]] Limits limits() const override { return {.radius_m = options_.radius_m}; }
  [[nodiscard]] std::string link() const override;
  [[nodiscard]] std::optional<std::uint16_t> take_carrier_code() override;
  void drive(Motion motion) override;
  void kill() override;
  void release() override { helm_.release(); }

 private:
  /// A scan that the odometry has not caught up with.
  struct Waiting {
    scans::BeamTimes times;  ///< by our clock
    std::vector<float> ranges_m;
  };
  void take(mavlink::Received const& received);
  void take_ranges(mavlink::Received const& received);
  void take_scan(scans::BeamTimes const& times, std::vector<float> ranges_m);
  void tell_scan();
  void tell_reading();
  void send(Motion motion);
  base::Task<> keep_watch();
  base::Task<> keep_asking();
  base::Task<> ask_for_messages();
  base::Task<> seek_origin();

  base::Loop& loop_;
  RoverBodyOptions options_;
  base::Logger log_;
  mavlink::Connection connection_;
  RoverHelm helm_;
  RoverTrack track_;
  RoverRanges ranges_;
  base::ClockOffset laser_clock_;
  std::unique_ptr<bus::Bus> bus_;
  std::unique_ptr<ros::RosLaser> laser_;
  Listener listener_;

  std::optional<Waiting> waiting_;
  std::optional<double> battery_;
  explore::SideDistances sides_{.left_m = 5.0, .front_m = 7.5, .right_m = 5.0};
  std::optional<base::TimePoint> heard_;   ///< its attitude or its place
  base::TimePoint carrier_told_{};         ///< of what was heard then the carrier's code was told
  std::optional<base::TimePoint> placed_;  ///< when it last said where it is
  base::Duration since_boot_{};
  bool has_origin_ = false;
  bool has_satellites_ = false;      ///< a receiver, whether it finds any or not
  base::TimePoint origin_missed_{};  ///< since when
  base::TimePoint told_at_{};
  Motion motion_;  ///< that it was told last
  base::TimePoint driven_at_{};
  bool is_waiting_ = false;  ///< nobody has renewed its command
  mavlink::Subscription subscription_;
  base::Scope scope_;
};

}  // namespace lapwing::robot::rover
