#include "robot/ros/drive_commands.hpp"

#include <utility>

namespace lapwing::robot::ros {

base::Result<DriveCommands> DriveCommands::open(bus::Bus& bus, std::string topic) {
  DriveCommands commands(bus, std::move(topic));
  if (auto opened = commands.turn_to<Plain>(); !opened) return std::unexpected(opened.error());
  return commands;
}

template <class Out>
base::Result<> DriveCommands::turn_to() {
  out_.emplace<std::monostate>();  // a topic has one type at a time
  auto opened = Out::open(*bus_, topic_, bus::Profile::standard);
  if (!opened) return std::unexpected(opened.error());
  out_.emplace<Out>(*std::move(opened));
  return {};
}

void DriveCommands::follow_readers() {
  bool const is_plain_read = bus_->is_read_as(topic_, bus::Description<bus::Twist>::name);
  bool const is_stamped_read = bus_->is_read_as(topic_, bus::Description<bus::TwistStamped>::name);
  // What does not open is tried again with the next look; meanwhile nobody reads.
  if (is_stamped_read && !is_plain_read && !std::holds_alternative<Stamped>(out_)) (void)turn_to<Stamped>();
  if (is_plain_read && !is_stamped_read && !std::holds_alternative<Plain>(out_)) (void)turn_to<Plain>();
}

void DriveCommands::send(Motion motion, std::string const& frame) {
  follow_readers();
  bus::Twist const twist{.linear = {.x = motion.speed_m_s}, .angular = {.z = motion.turn_rad_s}};
  if (auto* const plain = std::get_if<Plain>(&out_)) plain->publish(twist);
  if (auto* const stamped = std::get_if<Stamped>(&out_))
    stamped->publish({.header = {.stamp = {}, .frame_id = frame}, .twist = twist});
}

bool DriveCommands::is_read() const {
  if (auto const* const plain = std::get_if<Plain>(&out_)) return plain->readers() > 0;
  auto const* const stamped = std::get_if<Stamped>(&out_);
  return stamped && stamped->readers() > 0;
}

}  // namespace lapwing::robot::ros
