#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "mavlink/wire/frame.hpp"

namespace lapwing::sim {

/// What the speed controllers of up to four motors tell their autopilot.
struct SpeedControllers {
  std::array<std::optional<double>, 4> throttle{};  ///< 0..1; nothing where the output turns no motor
  double voltage_v = 0.0;
  double current_a = 0.0;  ///< of all together
  std::uint16_t updates = 0;
};

/// As ESC_TELEMETRY_1_TO_4.
[[nodiscard]] std::optional<mavlink::Frame> speed_controller_report(SpeedControllers const& told,
                                                                    mavlink::Address self);

}  // namespace lapwing::sim
