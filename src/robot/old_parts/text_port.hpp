#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "link/byte_link.hpp"
#include "map/live/live_map.hpp"
#include "robot/old_parts/order.hpp"
#include "robot/old_parts/told_points.hpp"
#include "robot/platform/robot.hpp"
#include "robot/seed_text/line.hpp"
#include "vehicle/authority.hpp"
#include "vehicle/control.hpp"

namespace lapwing::robot {

/// Where an old command centre or visualizer is joined with a robot: it hears in the seed's lines how the modules are,
/// where the robot is and what it has found, and kills, stops and starts it (docs/reference/robot-serial.md).
///
/// States are told ten times a second and not kept for who is away; points of interest reach everybody once and in
/// order, also who comes later. A module that is silent is silent here, too. A kill is carried out as it arrives.
/// Thread-bound.
class TextPort {
 public:
  /// All of these outlive it.
  struct Surroundings {
    base::Loop& loop;
    Robot& robot;
    vehicle::VehicleControl& control;
    vehicle::Authority& authority;
    map::LiveMap const& live_map;
  };
  TextPort(Surroundings around, std::unique_ptr<link::ByteLink> link, base::Logger log);
  TextPort(TextPort const&) = delete;
  TextPort& operator=(TextPort const&) = delete;

  /// Somebody is connected.
  [[nodiscard]] bool has_listener() const { return !listeners_.empty(); }

 private:
  struct Listener {
    seed_text::LineReader reader;
    std::uint64_t last_point = 0;  ///< that it was told of
  };
  base::Task<> keep_speaking();
  void meet_listeners();
  Listener& listener_at(link::Peer peer);
  void hear(link::Peer peer, link::Bytes bytes);
  void take(link::Peer peer, std::string_view line);
  void carry_out(Order order);
  void go_on();
  void command(vehicle::Action action);
  void complain(link::Peer peer, std::string const& why);
  [[nodiscard]] bool may_order_now();
  [[nodiscard]] std::string states() const;
  void tell_points(link::Peer peer, Listener& listener);
  bool send(link::Peer peer, std::string const& text, link::Urgency urgency);
  void add_line(std::string& text, Module from, Module to, std::string message) const;

  Surroundings around_;
  base::Logger log_;
  std::unique_ptr<link::ByteLink> link_;
  base::TimePoint began_;
  std::map<link::Peer, Listener> listeners_;
  ToldPoints points_;
  base::TimePoint orders_since_{};
  int orders_ = 0;  ///< in the second since then
  std::optional<base::TimePoint> complained_at_;
  std::uint64_t wrong_lines_ = 0;  ///< since that was said
  base::Scope scope_;
};

}  // namespace lapwing::robot
