#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/log.hpp"
#include "bus/participant/topics.hpp"
#include "scans/planar.hpp"
#include "scans/scan_reader.hpp"

namespace lapwing::robot::ros {

/// The laser of a robot as its driver publishes it on ROS 2: sensor_msgs/LaserScan, and where the laser sits on the
/// robot from /tf_static, or the topic of that name in the robot's own namespace.
class RosLaser {
 public:
  struct Seen {
    scans::BeamTimes times;       ///< by the driver's clock
    std::vector<float> ranges_m;  ///< in the order of `sensor()`
  };
  using OnScan = std::function<void(Seen)>;

  /// `name_space`: "/robot1" of "/robot1/scan"; empty: none. The bus outlives it. Errors: those of the topics.
  [[nodiscard]] static base::Result<std::unique_ptr<RosLaser>> open(base::Loop& loop, bus::Bus& bus,
                                                                    std::string const& name_space, OnScan on_scan,
                                                                    base::Logger log);
  RosLaser(RosLaser const&) = delete;
  RosLaser& operator=(RosLaser const&) = delete;

  /// The robot's own frame, as its driver calls it. Before this nothing is seen.
  void set_base_frame(std::string const& frame) { base_frame_ = frame; }
  /// Null until the first scan whose place is known, or is taken for granted.
  [[nodiscard]] slam::Sensor const* sensor() const { return scans_ ? &scans_->sensor() : nullptr; }

  /// Its frames are told in its own namespace, and not on /tf_static.
  [[nodiscard]] bool has_own_frames() const { return has_own_frames_; }

 private:
  RosLaser(base::Loop& loop, OnScan on_scan, base::Logger log)
      : loop_(loop), on_scan_(std::move(on_scan)), log_(std::move(log)) {}
  void take(bus::LaserScan const& scan);
  [[nodiscard]] std::optional<scans::PlanarFrame> mount_of(bus::LaserScan const& scan);

  base::Loop& loop_;
  OnScan on_scan_;
  base::Logger log_;
  std::optional<std::string> base_frame_;
  scans::StaticFrames frames_;
  std::optional<scans::ScanReader> scans_;
  std::optional<base::TimePoint> since_;
  bool has_own_frames_ = false;
  std::vector<bus::Subscription<bus::TFMessage>> frames_heard_;
  std::optional<bus::Subscription<bus::LaserScan>> laser_;
};

}  // namespace lapwing::robot::ros
