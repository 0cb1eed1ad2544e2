#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/async/notifier.hpp"
#include "base/async/task.hpp"
#include "bus/participant/bus.hpp"
#include "robot/ros/ros_picture.hpp"

namespace lapwing::robot::ros {

/// A camera whose pictures come over a topic of ROS 2: sensor_msgs/msg/Image, or sensor_msgs/msg/CompressedImage where
/// the topic's name ends in `/compressed`, as image_transport has it. What nobody has asked for is not decoded.
///
/// Thread-bound. Shares the bus, which may be several cameras'.
class RosCamera {
 public:
  /// What makes a picture of the bytes that came, on any thread.
  using Decode = base::Result<RosPicture> (*)(std::string const& bytes);
  struct Raw {
    std::string bytes;
    Decode decode = nullptr;
  };

  /// Errors: those of `bus::Bus::read_from`.
  [[nodiscard]] static base::Result<std::unique_ptr<RosCamera>> open(base::Loop& loop, std::shared_ptr<bus::Bus> bus,
                                                                     std::string const& topic);
  /// The next one that comes. Error, timed_out: none within a second.
  [[nodiscard]] base::Task<base::Result<Raw>> next();

 private:
  RosCamera(base::Loop& loop, std::shared_ptr<bus::Bus> bus, std::string topic);

  std::shared_ptr<bus::Bus> bus_;
  std::string topic_;
  Decode decode_;
  int waiting_ = 0;
  std::uint64_t heard_ = 0;
  std::string newest_;
  base::Notifier came_;
  std::unique_ptr<bus::Bus::Reader> reader_;
};

}  // namespace lapwing::robot::ros
