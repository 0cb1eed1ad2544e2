#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "mavlink/codec/messages.hpp"
#include "sim/autopilot/autopilot.hpp"

namespace lapwing::sim {

/// The sixteen outputs of an ArduPilot that a message tells of, and its relay: what its flight logic puts on them, and
/// what a ground station does by DO_SET_SERVO and DO_SET_RELAY.
class ServoOutputs {
 public:
  static constexpr std::size_t count = 16;
  using Pulses = std::array<std::uint16_t, count>;  ///< in microseconds; 0: nothing
  using Say = std::function<void(mavlink::MavSeverity, std::string)>;

  /// `parameters` outlive this.
  ServoOutputs(ParameterTable const& parameters, Say say) : parameters_(parameters), say_(std::move(say)) {}

  /// The answer to a command about servos and relays; nothing for other commands.
  std::optional<mavlink::MavResult> perform(mavlink::MavCmd command, std::array<float, 4> const& params);
  /// What is on the outputs while the vehicle does what it does.
  [[nodiscard]] Pulses pulses(Autopilot const& autopilot) const;
  [[nodiscard]] bool relay_is_on() const { return relay_is_on_; }

 private:
  mavlink::MavResult set_servo(int channel, int pulse_us);
  mavlink::MavResult set_relay(int number, int state);

  ParameterTable const& parameters_;
  Say say_;
  std::map<std::size_t, std::uint16_t> commanded_;  ///< by the output's index
  bool relay_is_on_ = false;
};

}  // namespace lapwing::sim
