#include "sim/model/flight_modes.hpp"

#include <algorithm>
#include <array>

#include "sim/model/px4_modes.hpp"

namespace lapwing::sim {

namespace {

using enum Behaviour;

// base_mode: custom 0x01, guided 0x08, stabilize 0x10, manual input 0x40. The copter and rover rows were read from
// HEARTBEATs of ArduCopter and ArduRover 4.6; the plane's follow ArduPlane's GCS_Plane::base_mode. FLIP and AUTOTUNE
// want a pilot with throttle, FLOWHOLD an optical flow sensor, SYSTEMID an axis, TURTLE speed controllers that turn
// backwards.
constexpr std::array copter_modes{
    FlightMode{0, "STABILIZE", manual, true, false, 0x51},
    FlightMode{1, "ACRO", manual, true, false, 0x51},
    FlightMode{2, "ALT_HOLD", sink, true, false, 0x51},
    FlightMode{3, "AUTO", mission, false, true, 0x59},
    FlightMode{4, "GUIDED", guided, true, true, 0x59},
    FlightMode{5, "LOITER", sink, true, true, 0x59},
    FlightMode{6, "RTL", return_home, false, true, 0x59},
    FlightMode{7, "CIRCLE", circle, false, true, 0x59},
    FlightMode{9, "LAND", land, false, false, 0x51},
    FlightMode{11, "DRIFT", sink, true, true, 0x51},
    FlightMode{14, "FLIP", sink, false, false, 0x51, Entry::closed},
    FlightMode{15, "AUTOTUNE", sink, false, false, 0x51, Entry::closed},
    FlightMode{16, "POSHOLD", sink, true, true, 0x59},
    FlightMode{17, "BRAKE", hold, false, true, 0x59},
    FlightMode{18, "THROW", manual, true, true, 0x51, Entry::disarmed},
    FlightMode{19, "AVOID_ADSB", hold, false, true, 0x59},
    FlightMode{20, "GUIDED_NOGPS", manual, true, false, 0x51},
    FlightMode{21, "SMART_RTL", retrace, false, true, 0x59},
    FlightMode{22, "FLOWHOLD", sink, true, false, 0x51, Entry::closed},
    FlightMode{23, "FOLLOW", hold, false, true, 0x59, Entry::closed, "Set FOLL_ENABLE = 1"},
    FlightMode{24, "ZIGZAG", sink, true, true, 0x51},
    FlightMode{25, "SYSTEMID", manual, false, false, 0x51, Entry::closed, "No axis selected, SID_AXIS = 0"},
    FlightMode{27, "AUTO_RTL", return_home, false, true, 0x59},
    FlightMode{28, "TURTLE", manual, true, false, 0x51, Entry::closed},
};

constexpr std::array rover_modes{
    FlightMode{0, "MANUAL", manual, true, false, 0x41},
    FlightMode{1, "ACRO", manual, true, false, 0x51},
    FlightMode{3, "STEERING", manual, true, false, 0x51},
    FlightMode{4, "HOLD", hold, true, false, 0x01},
    FlightMode{5, "LOITER", hold, true, true, 0x09},
    FlightMode{6, "FOLLOW", hold, true, true, 0x09},
    FlightMode{7, "SIMPLE", manual, true, false, 0x41},
    FlightMode{8, "DOCK", hold, false, true, 0x09},
    FlightMode{9, "CIRCLE", circle, true, true, 0x09},
    FlightMode{10, "AUTO", mission, true, true, 0x09},
    FlightMode{11, "RTL", return_home, true, true, 0x09},
    FlightMode{12, "SMART_RTL", retrace, true, true, 0x09},
    FlightMode{15, "GUIDED", guided, true, true, 0x09},
    FlightMode{16, "INITIALISING", manual, false, false, 0x01, Entry::closed},
};

/// Said of the modes of an aeroplane that hovers.
constexpr std::string_view no_rotors = "Q_ENABLE 0";
constexpr std::array plane_modes{
    FlightMode{0, "MANUAL", manual, true, false, 0x41},
    FlightMode{1, "CIRCLE", circle, true, false, 0x59},
    FlightMode{2, "STABILIZE", manual, true, false, 0x51},
    FlightMode{3, "TRAINING", manual, true, false, 0x41},
    FlightMode{4, "ACRO", manual, true, false, 0x51},
    FlightMode{5, "FBWA", manual, true, false, 0x51},
    FlightMode{6, "FBWB", manual, true, false, 0x51},
    FlightMode{7, "CRUISE", manual, true, false, 0x51},
    FlightMode{8, "AUTOTUNE", manual, true, false, 0x51},
    FlightMode{10, "AUTO", mission, true, true, 0x59},
    FlightMode{11, "RTL", return_home, false, true, 0x59},
    FlightMode{12, "LOITER", hold, true, true, 0x59},
    FlightMode{13, "TAKEOFF", take_off, true, true, 0x59},
    FlightMode{14, "AVOID_ADSB", hold, false, true, 0x59},
    FlightMode{15, "GUIDED", guided, true, true, 0x59},
    FlightMode{16, "INITIALISING", manual, false, false, 0x11, Entry::closed},
    FlightMode{17, "QSTABILIZE", hold, true, false, 0x51, Entry::closed, no_rotors},
    FlightMode{18, "QHOVER", hold, true, false, 0x51, Entry::closed, no_rotors},
    FlightMode{19, "QLOITER", hold, true, true, 0x51, Entry::closed, no_rotors},
    FlightMode{20, "QLAND", hold, false, true, 0x51, Entry::closed, no_rotors},
    FlightMode{21, "QRTL", hold, false, true, 0x59, Entry::closed, no_rotors},
    FlightMode{22, "QAUTOTUNE", hold, false, false, 0x51, Entry::closed, no_rotors},
    FlightMode{23, "QACRO", hold, true, false, 0x51, Entry::closed, no_rotors},
    FlightMode{24, "THERMAL", hold, true, true, 0x59, Entry::closed},
};

// ArduSub's numbers; its base modes are the copter's.
constexpr std::array sub_modes{
    FlightMode{19, "MANUAL", manual, true, false, 0x51}, FlightMode{0, "STABILIZE", manual, true, false, 0x51},
    FlightMode{1, "ACRO", manual, true, false, 0x51},    FlightMode{2, "ALT_HOLD", hold, true, false, 0x51},
    FlightMode{3, "AUTO", mission, true, true, 0x59},    FlightMode{4, "GUIDED", guided, true, true, 0x59},
    FlightMode{7, "CIRCLE", circle, true, true, 0x59},   FlightMode{9, "SURFACE", land, true, false, 0x51},
    FlightMode{16, "POSHOLD", hold, true, true, 0x59},
};

// PX4: the same for every kind of vehicle. The first is where it is after the start without a remote control. Base
// modes as its HEARTBEAT stream makes them of control flags: AUTO 0x04, stabilize and guided in the automatic modes.
constexpr std::array px4_modes{
    FlightMode{px4_mode(4, 3), "AUTO.LOITER", guided, true, true, 0x1D},
    FlightMode{px4_mode(4, 2), "AUTO.TAKEOFF", take_off, true, true, 0x1D},
    FlightMode{px4_mode(4, 4), "AUTO.MISSION", mission, true, true, 0x1D},
    FlightMode{px4_mode(4, 5), "AUTO.RTL", return_home, false, true, 0x1D},
    FlightMode{px4_mode(4, 6), "AUTO.LAND", land, false, false, 0x1D},
    FlightMode{px4_offboard, "OFFBOARD", guided, true, true, 0x1D},
    FlightMode{px4_mode(1), "MANUAL", manual, true, false, 0x51},
    FlightMode{px4_mode(2), "ALTCTL", manual, true, false, 0x51},
    FlightMode{px4_mode(3), "POSCTL", manual, true, true, 0x51},
    FlightMode{px4_mode(5), "ACRO", manual, true, false, 0x41},
    FlightMode{px4_mode(7), "STABILIZED", manual, true, false, 0x51},
};

/// The behaviour that stands in for one that a vehicle has no mode for.
Behaviour instead_of(Behaviour behaviour) {
  if (behaviour == hold) return guided;
  return behaviour == land || behaviour == retrace ? return_home : land;
}

}  // namespace

std::span<FlightMode const> flight_modes(Kind const& kind) {
  using enum vehicle::Family;
  if (kind.is_px4()) return px4_modes;
  if (kind.family == plane) return plane_modes;
  if (kind.family == rover || kind.family == boat) return rover_modes;
  if (kind.family == sub) return sub_modes;
  return copter_modes;
}

FlightMode const* find_mode(Kind const& kind, std::uint32_t number) {
  auto const modes = flight_modes(kind);
  auto const found = std::ranges::find(modes, number, &FlightMode::number);
  return found == modes.end() ? nullptr : &*found;
}

FlightMode const& mode_for(Kind const& kind, Behaviour behaviour) {
  // The rover's HOLD and the plane's LOITER are the first rows that hold; the copter's is BRAKE.
  auto const modes = flight_modes(kind);
  auto const found = std::ranges::find(modes, behaviour, &FlightMode::behaviour);
  return found == modes.end() ? mode_for(kind, instead_of(behaviour)) : *found;
}

FlightMode const& initial_mode(Kind const& kind) {
  return flight_modes(kind).front();
}

}  // namespace lapwing::sim
