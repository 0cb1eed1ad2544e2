#pragma once

#include <optional>

#include "sim/failsafe.hpp"
#include "sim/flight_modes.hpp"
#include "sim/parameters.hpp"

namespace lapwing::sim {

/// The limits of the fence that parameters set, SI, and what is done about a breach.
struct FenceSettings {
  bool enabled = false;
  unsigned watched = 0;        ///< bits of FenceWatch::Limit
  double radius_m = 0.0;       ///< round home
  double highest_m = 0.0;      ///< above home
  double lowest_m = 0.0;       ///< above home; counts once the vehicle has been above it
  bool any_inclusion = false;  ///< one of several inclusion areas is enough; else the vehicle has to be in each
  bool holds_mode = false;     ///< what the breach made of the mode stays until the vehicle is back inside
  std::optional<Behaviour> action{};
};

/// What a vehicle does by itself when something goes wrong: its parameters in SI. Where an action is empty the vehicle
/// only says so.
struct Safety {
  BatteryLimits battery{};
  std::optional<Behaviour> on_low_battery{};
  std::optional<Behaviour> on_critical_battery{};
  bool watches_ground_station = false;
  base::Duration ground_station_patience{};
  std::optional<Behaviour> on_ground_station_lost{};
  bool keeps_mission = false;  ///< a mission goes on without the ground station
  std::optional<Behaviour> on_estimate_lost{};
  bool in_every_mode = false;  ///< not only in those that need a position
  FenceSettings fence{};
  bool gps_is_cut_off = false;  ///< SIM_GPS_DISABLE, as in ArduPilot's simulator
};
[[nodiscard]] Safety safety_from(Kind const& kind, Parameters const& parameters);

}  // namespace lapwing::sim
