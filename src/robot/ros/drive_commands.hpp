#pragma once

#include <string>
#include <variant>

#include "bus/messages/common.hpp"
#include "bus/participant/topics.hpp"
#include "robot/planner/way.hpp"

namespace lapwing::robot::ros {

/// What a base is told on its topic, in the type by which its driver reads that: `geometry_msgs/Twist`, or
/// `TwistStamped`, as most drivers do since ROS 2 Jazzy. Its stamp is zero, which they take for now: clocks need not
/// agree. Where somebody reads either, a driver or who only watches, it stays with what it began with.
class DriveCommands {
 public:
  /// The bus outlives it. Errors: those of `bus::Publisher::open`.
  [[nodiscard]] static base::Result<DriveCommands> open(bus::Bus& bus, std::string topic);

  /// Turns to the other type where that alone is read; to be asked now and then.
  void follow_readers();
  void send(Motion motion, std::string const& frame);
  [[nodiscard]] bool is_read() const;

 private:
  using Plain = bus::Publisher<bus::Twist>;
  using Stamped = bus::Publisher<bus::TwistStamped>;
  DriveCommands(bus::Bus& bus, std::string topic) : bus_(&bus), topic_(std::move(topic)) {}
  template <class Out>
  base::Result<> turn_to();

  bus::Bus* bus_;
  std::string topic_;
  std::variant<std::monostate, Plain, Stamped> out_;
};

}  // namespace lapwing::robot::ros
