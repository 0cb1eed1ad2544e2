#pragma once

#include <vector>

#include "sim/model/flight_modes.hpp"
#include "sim/model/parameter_table.hpp"
#include "sim/safety/failsafe.hpp"

namespace lapwing::sim {

/// What is tried in this order until the vehicle goes into one of them; empty: it only says that something is wrong.
using Reaction = std::vector<Behaviour>;

/// The limits of the fence that parameters set, SI, and what is done about a breach.
struct FenceSettings {
  bool enabled = false;
  unsigned watched = 0;         ///< bits of FenceWatch::Limit
  double radius_m = 0.0;        ///< round home
  double highest_m = 0.0;       ///< above home
  double lowest_m = 0.0;        ///< above home; counts once the vehicle has been above it
  double margin_m = 0.0;        ///< inside the limits, where the vehicle is warned
  bool tells_margin = false;    ///< in texts
  double again_after_m = 20.0;  ///< a circle or height is breached anew so far beyond the last breach
  double give_up_m = 100.0;     ///< farther out than this `far_action` is taken
  bool any_inclusion = false;   ///< one of several inclusion areas is enough; else the vehicle has to be in each
  bool holds_mode = false;      ///< what the breach made of the mode stays until the vehicle is back inside
  bool tells_breach = true;     ///< in texts; a rover does not
  Reaction action{};
  Reaction far_action{};
};

/// What the receiver of the remote control gets, by SIM_RC_FAIL of ArduPilot's own simulator.
enum class RadioSignal {
  good,
  none,         ///< no pulses
  low_throttle  ///< the throttle below the least of a working transmitter, as old receivers tell of a loss
};

/// What to do about a lost link, and when to carry on all the same.
struct LossSettings {
  bool watched = false;
  base::Duration patience{};
  Reaction reaction{};
  bool keeps_mission = false;
  bool keeps_guided = false;
  bool keeps_pilot = false;  ///< modes that a pilot flies
};

/// What a vehicle does by itself when something goes wrong: its parameters in SI.
struct Safety {
  BatteryLimits battery{};
  Reaction on_low_battery{};
  Reaction on_critical_battery{};
  LossSettings ground{};
  LossSettings radio{};
  RadioSignal signal = RadioSignal::good;
  base::Duration low_throttle_patience{};
  base::Duration long_after{};  ///< an aeroplane's second, longer patience, after the first
  bool finishes_landing = false;
  Reaction on_estimate_lost{};
  bool in_every_mode = false;  ///< not only in those that need a position
  FenceSettings fence{};
  bool gps_is_cut_off = false;  ///< SIM_GPS_DISABLE, as in ArduPilot's simulator
};
[[nodiscard]] Safety safety_from(Kind const& kind, ParameterTable const& parameters);

}  // namespace lapwing::sim
