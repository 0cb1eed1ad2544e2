#pragma once

#include "vehicle/family.hpp"

namespace lapwing::sim {

/// Which program steers what: decides modes, parameters, the mission protocol's habits and the words.
struct Kind {
  vehicle::Family family = vehicle::Family::copter;
  vehicle::Autopilot firmware = vehicle::Autopilot::ardupilot;  ///< or px4

  [[nodiscard]] bool is_px4() const { return firmware == vehicle::Autopilot::px4; }
  friend bool operator==(Kind const&, Kind const&) = default;
};

}  // namespace lapwing::sim
