#include "robot/ros/ros_laser.hpp"

#include <utility>

#include <fmt/format.h>

#include "scans/stamp.hpp"

namespace lapwing::robot::ros {

using namespace std::chrono_literals;

namespace {

/// So long a scan waits for the frame of its laser to be told.
constexpr base::Duration frames_come_within = 3s;

}  // namespace

base::Result<std::unique_ptr<RosLaser>> RosLaser::open(base::Loop& loop, bus::Bus& bus, std::string const& name_space,
                                                       OnScan on_scan, base::Logger log) {
  auto laser = std::unique_ptr<RosLaser>(new RosLaser(loop, std::move(on_scan), std::move(log)));
  // Frames are told before what is measured in them.
  std::vector<std::string> own{""};
  if (!name_space.empty()) own.push_back(name_space);
  for (auto const& in : own) {
    auto frames = bus::Subscription<bus::TFMessage>::open(bus, in + "/tf_static", bus::Profile::latched,
                                                          [self = laser.get(), is_own = !in.empty()](auto const& told) {
                                                            self->frames_.take(told);
                                                            self->has_own_frames_ = self->has_own_frames_ || is_own;
                                                          });
    if (!frames) return std::unexpected(frames.error());
    laser->frames_heard_.push_back(*std::move(frames));
  }
  auto scans = bus::Subscription<bus::LaserScan>::open(bus, name_space + "/scan", bus::Profile::sensor_data,
                                                       [self = laser.get()](auto const& scan) { self->take(scan); });
  if (!scans) return std::unexpected(scans.error());
  laser->laser_.emplace(*std::move(scans));
  return laser;
}

void RosLaser::take(bus::LaserScan const& scan) {
  if (!base_frame_) return;
  if (!scans_) {
    auto const mount = mount_of(scan);
    if (!mount) return;
    scans_ = scans::ScanReader::make(scan, *mount);
    if (!scans_) return;
    log_.info(fmt::format("a laser of {} beams, {:.2f} m ahead and {:.2f} m to the left of {}", scan.ranges.size(),
                          mount->pose.x, mount->pose.y, *base_frame_));
  }
  auto ranges = scans_->ranges(scan);
  if (!ranges) return;  // of another laser on the same topic
  on_scan_({.times = scans_->times(scan, scans::since_epoch(scan.header.stamp)), .ranges_m = *std::move(ranges)});
}

std::optional<scans::PlanarFrame> RosLaser::mount_of(bus::LaserScan const& scan) {
  if (!since_) since_ = loop_.now();
  if (auto const mount = frames_.find(scan.header.frame_id, *base_frame_)) return mount;
  if (loop_.now() - *since_ < frames_come_within) return std::nullopt;
  log_.warn(fmt::format("/tf_static does not say where {} is on {}: it is taken for its middle, looking ahead",
                        scan.header.frame_id, *base_frame_));
  return scans::PlanarFrame{};
}

}  // namespace lapwing::robot::ros
