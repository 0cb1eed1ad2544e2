#pragma once

#include <optional>

#include "base/time.hpp"
#include "vehicle/energy/endurance.hpp"

namespace lapwing::autonomy {

/// How the drone flies home, and how careful one is about it. The speeds are those that a copter of ArduPilot has from
/// the start (WPNAV_SPEED, WPNAV_SPEED_UP, WPNAV_SPEED_DN, LAND_SPEED, LAND_ALT_LOW, RTL_LOIT_TIME).
struct ReserveOptions {
  double cruise_m_s = 10.0;
  double climb_m_s = 2.5;
  double descent_m_s = 1.5;
  double landing_m_s = 0.5;
  double landing_below_m = 10.0;
  base::Duration wait_over_home = std::chrono::seconds(5);
  double headwind_m_s = 4.0;       ///< that may stand on the way home: a gentle breeze, for nobody measures it
  double hover_induced_m_s = 5.0;  ///< how fast the rotors move air in hover: 4 to 6 for drones of 1 to 5 kg

  double margin = 0.05;        ///< of a full charge, on top of what the way home takes
  double least = 0.15;         ///< below that share cells give in
  double when_unknown = 0.20;  ///< as long as nobody knows what flying draws
};

/// What the way home begins with.
struct WayHome {
  double distance_m = 0.0;       ///< level
  double height_m = 0.0;         ///< above home
  double return_height_m = 0.0;  ///< to which it climbs first, when it is lower
};

/// How long the way home and the landing take, a climb counted by what it draws: as so much time in hover.
/// A climb at v draws v/(2w) + sqrt((v/(2w))^2 + 1) times what hovering does, with w the induced velocity in hover
/// (momentum theory; Leishman, Principles of Helicopter Aerodynamics, 2.13). Sinking counts as hovering, though it
/// draws less. Nothing when the headwind leaves no way home.
[[nodiscard]] std::optional<base::Duration> hover_time_home(WayHome const& way, ReserveOptions const& options);

/// The share of a full charge at which it has to go home: what the way takes at `drain`, with the drain's error against
/// it, and the margin; within [`least`, 1]. `when_unknown` where the way or the drain is not known, and 1 where there
/// is no way home.
[[nodiscard]] double reserve(std::optional<WayHome> const& way, std::optional<vehicle::Drain> const& drain,
                             ReserveOptions const& options);

/// How long it may go on flying until it has to be over home, to land from `height_m` above it with what has to be left
/// then: counted with the drain's error against it, zero when it should be there already. Nothing as long as nobody
/// knows what flying draws.
[[nodiscard]] std::optional<base::Duration> flying_time_left(double charge, double height_m, double return_height_m,
                                                             std::optional<vehicle::Drain> const& drain,
                                                             ReserveOptions const& options);

}  // namespace lapwing::autonomy
