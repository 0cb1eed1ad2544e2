#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::sim::building {

/// What can be broken on a robot, by a test or by a person.
struct Fault {
  enum class Kind : std::uint8_t {
    sonar_stuck,     ///< says for ever what it said last
    sonar_silent,    ///< hears no echo
    sonar_jumps,     ///< says anything
    laser_silent,    ///< no scans
    imu_silent,      ///< no samples
    wheel_slips,     ///< the ground under it moves by `amount` of what the wheel turns
    encoder_dead,    ///< counts no pulses
    unplugged,       ///< nothing goes over the line in either direction; the board runs on
    halted,          ///< the board's program stands still; its motors keep their voltages
    battery_low,     ///< `amount` of the charge is left
    camera_dark,     ///< pictures have `amount` of the light
    camera_blurred,  ///< pictures are out of focus by `amount` pixels
    camera_silent,   ///< no pictures
  };
  Kind kind = Kind::sonar_stuck;
  int which = 0;  ///< sonar in the description's order; wheel: 0 left, 1 right
  std::optional<double> amount = std::nullopt;
  friend bool operator==(Fault const&, Fault const&) = default;
};

[[nodiscard]] std::string_view to_string(Fault::Kind kind);

/// `sonar-stuck:2`, `wheel-slips:left=0.5`, `imu-silent`. Error, invalid_input: an unknown name, a number that cannot
/// be.
[[nodiscard]] base::Result<Fault> parse_fault(std::string_view text);

}  // namespace lapwing::sim::building
