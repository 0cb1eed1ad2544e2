#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "mavlink/codec/enums.hpp"
#include "vehicle/family.hpp"

/// Flight modes by name and by what they are for: `custom_mode` of HEARTBEAT for ArduPilot (its source, mode.h of each
/// vehicle) and PX4 (px4_custom_mode.h: main mode in bits 16..23, sub mode in bits 24..31).
namespace lapwing::mavlink {

using vehicle::Autopilot;
using vehicle::Family;

/// PX4's number of a mode.
[[nodiscard]] constexpr std::uint32_t px4_mode(std::uint32_t main, std::uint32_t sub = 0) {
  return main << 16U | sub << 24U;
}
inline constexpr std::uint32_t px4_auto = px4_mode(4);  ///< asked for without a sub mode it is the mission's
inline constexpr std::uint32_t px4_auto_mission = px4_mode(4, 4);
inline constexpr std::uint32_t px4_offboard = px4_mode(6);

/// What moves, from the heartbeat. `unknown` for what is no vehicle: ground stations, gimbals, cameras, trackers,
/// ADS-B.
[[nodiscard]] Family family_of(MavType type);
[[nodiscard]] Autopilot autopilot_of(MavAutopilot autopilot);

/// The autopilot's own name, "AUTO"; "mode 42" for a number that is not in its table.
[[nodiscard]] std::string mode_name(Autopilot autopilot, Family family, std::uint32_t custom_mode);
/// The name in our tables; empty for a number that is not there. Takes the vehicle's type because not every one that
/// ArduPilot moves has a family here (Blimp).
[[nodiscard]] std::string_view known_mode_name(Autopilot autopilot, Family family, MavType type,
                                               std::uint32_t custom_mode);
/// The number of a name, letter case ignored.
[[nodiscard]] std::optional<std::uint32_t> mode_number(Autopilot autopilot, Family family, std::string_view name);

/// What a mode is wanted for.
enum class ModeRole {
  mission,  ///< fly the uploaded mission
  guided,   ///< go where the ground says
  hold,  ///< stay here without a pilot's sticks: copter BRAKE (LOITER sinks without RC input), plane LOITER, rover HOLD
  rtl,   ///< return to launch
  land,  ///< land here
};
/// The mode for the role; nothing where the vehicle has none (a rover cannot land).
[[nodiscard]] std::optional<std::uint32_t> mode_for(Autopilot autopilot, Family family, ModeRole role);

}  // namespace lapwing::mavlink
