#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "link/pipe_link.hpp"
#include "mavlink/connection/connection.hpp"
#include "robot/testing/simple_body.hpp"

namespace lapwing::robot::rover::testing {

constexpr std::uint32_t manual = 0;
constexpr std::uint32_t hold = 4;
constexpr std::uint32_t guided = 15;

/// The far end of a rover's link: an autopilot that takes modes, arming and setpoints as ArduPilot's Rover does, on a
/// disc with wheels among walls, and a companion computer that tells what its laser sees as OBSTACLE_DISTANCE.
class ScriptedRover {
 public:
  ScriptedRover(base::Loop& loop, std::unique_ptr<link::ByteLink> link, robot::testing::Walls walls,
                robot::testing::SimpleBodyOptions const& options = {});

  [[nodiscard]] robot::testing::SimpleBody& wheels() { return wheels_; }
  [[nodiscard]] bool stands() const { return motion == Motion{}; }
  template <class M>
  [[nodiscard]] std::vector<M> all() const {
    std::vector<M> found;
    for (auto const& message : heard)
      if (auto const* m = std::get_if<M>(&message)) found.push_back(*m);
    return found;
  }
  /// How often it was told to do that.
  [[nodiscard]] int commanded(mavlink::MavCmd command, float first) const;
  void tell(mavlink::Message const& message) { connection_.send_to_all(message); }
  void say(std::string text);

  std::vector<mavlink::Message> heard;
  std::uint32_t mode = manual;
  bool is_armed = false;
  Motion motion;  ///< that its wheels are told

  // ---- what tests do to it
  std::optional<std::string> objects_to_arming;  ///< it says so
  bool is_mute = false;                          ///< neither hears nor speaks
  bool has_ranges = true;
  bool has_place = true;
  bool has_origin = true;
  bool is_deaf_to_stops = false;  ///< loses every HOLD and disarming
  mavlink::MavType type = mavlink::MavType::ground_rover;
  double jump_m = 0.0;  ///< of its estimator, to the north

 private:
  void on(mavlink::Message const& message);
  void on(mavlink::CommandLong const& command);
  void on(mavlink::SetPositionTargetLocalNed const& setpoint);
  [[nodiscard]] mavlink::MavResult tell_on_request(float message);
  [[nodiscard]] mavlink::MavResult perform(mavlink::CommandLong const& command);
  void tell(Reading const& reading);
  void tell(slam::Scan const& scan);
  base::Task<> live();
  [[nodiscard]] mavlink::Heartbeat heartbeat() const;

  base::Loop& loop_;
  robot::testing::SimpleBody wheels_;
  mavlink::Connection connection_;
  mavlink::Subscription subscription_;
  base::TimePoint steered_at_{};
  std::optional<Reading> before_;
  base::Task<> life_;
};

}  // namespace lapwing::robot::rover::testing
