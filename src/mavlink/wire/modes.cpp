#include "mavlink/wire/modes.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include <fmt/format.h>

namespace lapwing::mavlink {

namespace {

struct Mode {
  std::uint32_t number;
  std::string_view name;
};

auto constexpr copter_modes = std::to_array<Mode>({
    {0, "STABILIZE"},  {1, "ACRO"},      {2, "ALT_HOLD"},   {3, "AUTO"},     {4, "GUIDED"},      {5, "LOITER"},
    {6, "RTL"},        {7, "CIRCLE"},    {9, "LAND"},       {11, "DRIFT"},   {13, "SPORT"},      {14, "FLIP"},
    {15, "AUTOTUNE"},  {16, "POSHOLD"},  {17, "BRAKE"},     {18, "THROW"},   {19, "AVOID_ADSB"}, {20, "GUIDED_NOGPS"},
    {21, "SMART_RTL"}, {22, "FLOWHOLD"}, {23, "FOLLOW"},    {24, "ZIGZAG"},  {25, "SYSTEMID"},   {26, "AUTOROTATE"},
    {27, "AUTO_RTL"},  {28, "TURTLE"},   {29, "RATE_ACRO"}, {8, "POSITION"}, {10, "OF_LOITER"},
});

auto constexpr plane_modes = std::to_array<Mode>({
    {0, "MANUAL"},        {1, "CIRCLE"},      {2, "STABILIZE"}, {3, "TRAINING"},    {4, "ACRO"},
    {5, "FBWA"},          {6, "FBWB"},        {7, "CRUISE"},    {8, "AUTOTUNE"},    {10, "AUTO"},
    {11, "RTL"},          {12, "LOITER"},     {13, "TAKEOFF"},  {14, "AVOID_ADSB"}, {15, "GUIDED"},
    {16, "INITIALISING"}, {17, "QSTABILIZE"}, {18, "QHOVER"},   {19, "QLOITER"},    {20, "QLAND"},
    {21, "QRTL"},         {22, "QAUTOTUNE"},  {23, "QACRO"},    {24, "THERMAL"},    {25, "LOITERALTQLAND"},
    {26, "AUTOLAND"},
});

auto constexpr rover_modes = std::to_array<Mode>({
    {0, "MANUAL"},
    {1, "ACRO"},
    {2, "LEARNING"},
    {3, "STEERING"},
    {4, "HOLD"},
    {5, "LOITER"},
    {6, "FOLLOW"},
    {7, "SIMPLE"},
    {8, "DOCK"},
    {9, "CIRCLE"},
    {10, "AUTO"},
    {11, "RTL"},
    {12, "SMART_RTL"},
    {15, "GUIDED"},
    {16, "INITIALISING"},
});

auto constexpr sub_modes = std::to_array<Mode>({
    {0, "STABILIZE"},
    {1, "ACRO"},
    {2, "ALT_HOLD"},
    {3, "AUTO"},
    {4, "GUIDED"},
    {7, "CIRCLE"},
    {9, "SURFACE"},
    {16, "POSHOLD"},
    {19, "MANUAL"},
    {20, "MOTOR_DETECT"},
    {21, "SURFTRAK"},
});

auto constexpr blimp_modes = std::to_array<Mode>({
    {0, "LAND"},
    {1, "MANUAL"},
    {2, "VELOCITY"},
    {3, "LOITER"},
    {4, "RTL"},
    {5, "AUTO"},
    {6, "HOLD"},
});

auto constexpr px4_modes = std::to_array<Mode>({
    {px4_mode(1), "MANUAL"},
    {px4_mode(2), "ALTCTL"},
    {px4_mode(3), "POSCTL"},
    {px4_mode(3, 1), "ORBIT"},
    {px4_mode(3, 2), "POSITION_SLOW"},
    {px4_mode(4, 1), "AUTO.READY"},
    {px4_mode(4, 2), "AUTO.TAKEOFF"},
    {px4_mode(4, 3), "AUTO.LOITER"},
    {px4_mode(4, 4), "AUTO.MISSION"},
    {px4_mode(4, 5), "AUTO.RTL"},
    {px4_mode(4, 6), "AUTO.LAND"},
    {px4_mode(4, 7), "AUTO.RTGS"},
    {px4_mode(4, 8), "AUTO.FOLLOW_TARGET"},
    {px4_mode(4, 9), "AUTO.PRECLAND"},
    {px4_mode(4, 10), "AUTO.VTOL_TAKEOFF"},
    {px4_mode(5), "ACRO"},
    {px4_mode(6), "OFFBOARD"},
    {px4_mode(7), "STABILIZED"},
    {px4_mode(8), "RATTITUDE"},
    {px4_mode(10), "TERMINATION"},
    {px4_mode(11), "ALTITUDE_CRUISE"},
});

std::span<Mode const> modes_of(Autopilot autopilot, Family family) {
  if (autopilot == Autopilot::px4) return px4_modes;
  if (autopilot != Autopilot::ardupilot) return {};
  switch (family) {
    case Family::copter: return copter_modes;
    case Family::plane:
    case Family::vtol: return plane_modes;
    case Family::rover:
    case Family::boat: return rover_modes;
    case Family::sub: return sub_modes;
    case Family::robot:
    case Family::unknown: return {};
  }
  return {};
}

/// The name of the mode for a role; empty where there is none.
std::string_view role_name(Family family, ModeRole role) {
  switch (role) {
    case ModeRole::mission: return "AUTO";
    case ModeRole::guided: return "GUIDED";
    case ModeRole::rtl: return family == Family::sub ? "" : "RTL";
    case ModeRole::hold:
      if (family == Family::copter) return "BRAKE";
      if (family == Family::rover) return "HOLD";
      return family == Family::sub ? "POSHOLD" : "LOITER";  // a boat in HOLD drifts away
    case ModeRole::land:
      if (family == Family::copter) return "LAND";
      if (family == Family::vtol) return "QLAND";
      return family == Family::sub ? "SURFACE" : "";
  }
  return "";
}

std::string_view px4_role_name(Family family, ModeRole role) {
  switch (role) {
    case ModeRole::mission: return "AUTO.MISSION";
    case ModeRole::guided:  // goes where DO_REPOSITION says
    case ModeRole::hold: return "AUTO.LOITER";
    case ModeRole::rtl: return "AUTO.RTL";
    case ModeRole::land: return family == Family::rover || family == Family::boat ? "" : "AUTO.LAND";
  }
  return "";
}

bool same_letters(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](unsigned char x, unsigned char y) { return std::toupper(x) == std::toupper(y); });
}

}  // namespace

Family family_of(MavType type) {
  switch (type) {
    case MavType::quadrotor:
    case MavType::coaxial:
    case MavType::helicopter:
    case MavType::hexarotor:
    case MavType::octorotor:
    case MavType::tricopter:
    case MavType::dodecarotor:
    case MavType::decarotor: return Family::copter;
    case MavType::fixed_wing:
    case MavType::flapping_wing:
    case MavType::parafoil: return Family::plane;
    case MavType::vtol_tailsitter_duorotor:
    case MavType::vtol_tailsitter_quadrotor:
    case MavType::vtol_tiltrotor:
    case MavType::vtol_fixedrotor:
    case MavType::vtol_tailsitter:
    case MavType::vtol_tiltwing:
    case MavType::vtol_reserved5: return Family::vtol;
    case MavType::ground_rover: return Family::rover;
    case MavType::surface_boat: return Family::boat;
    case MavType::submarine: return Family::sub;
    default: return Family::unknown;
  }
}

Autopilot autopilot_of(MavAutopilot autopilot) {
  if (autopilot == MavAutopilot::ardupilotmega) return Autopilot::ardupilot;
  if (autopilot == MavAutopilot::px4) return Autopilot::px4;
  return Autopilot::other;
}

std::string_view known_mode_name(Autopilot autopilot, Family family, MavType type, std::uint32_t custom_mode) {
  bool const is_blimp = autopilot == Autopilot::ardupilot && type == MavType::airship;
  auto const modes = is_blimp ? std::span<Mode const>(blimp_modes) : modes_of(autopilot, family);
  auto const found = std::ranges::find(modes, custom_mode, &Mode::number);
  return found == modes.end() ? std::string_view() : found->name;
}

std::string mode_name(Autopilot autopilot, Family family, std::uint32_t custom_mode) {
  auto const known = known_mode_name(autopilot, family, MavType::generic, custom_mode);
  if (!known.empty()) return std::string(known);
  if (autopilot == Autopilot::px4) return fmt::format("mode {}.{}", custom_mode >> 16U & 0xFFU, custom_mode >> 24U);
  return fmt::format("mode {}", custom_mode);
}

std::optional<std::uint32_t> mode_number(Autopilot autopilot, Family family, std::string_view name) {
  for (auto const& mode : modes_of(autopilot, family))
    if (same_letters(mode.name, name)) return mode.number;
  return std::nullopt;
}

std::optional<std::uint32_t> mode_for(Autopilot autopilot, Family family, ModeRole role) {
  auto const name = autopilot == Autopilot::px4 ? px4_role_name(family, role) : role_name(family, role);
  return mode_number(autopilot, family, name);
}

}  // namespace lapwing::mavlink
