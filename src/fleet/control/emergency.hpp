#pragma once

#include <functional>
#include <map>
#include <string>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "fleet/network/fleet.hpp"
#include "vehicle/control.hpp"

namespace lapwing::fleet {

/// The latched stop of a whole fleet: sends every vehicle its stop until the vehicle has acknowledged it and shows it,
/// those that appear while it is latched too, and holds back every other message that would move one. Where a second
/// vehicle may have come under the same id, both are stopped until it is known that there is one.
///
/// A vehicle that stood and leaves its stop within seconds carries out what was sent before: it is stopped again. Later
/// than that its pilot has taken it, who knows better; that is only told. Thread-bound.
class Emergency {
 public:
  /// `changed` is called after every change of the state. The fleet outlives this.
  Emergency(Fleet& fleet, std::function<void()> changed, base::Logger log);
  ~Emergency();
  Emergency(Emergency const&) = delete;
  Emergency& operator=(Emergency const&) = delete;

  void latch(vehicle::StopAction action, vehicle::Commander by);
  void release(vehicle::Commander const& by);
  /// The operator commands this vehicle another kind of stop: it is no longer pursued with this one.
  void leave_to_operator(vehicle::VehicleId const& id);
  /// That came to nothing: it is pursued again.
  void resume(MavlinkVehicle& craft);
  [[nodiscard]] vehicle::EmergencyStop const& state() const { return state_; }

 private:
  struct Pursuit {
    base::Task<> task;
    bool is_left_to_pilot = false;
  };
  void join(MavlinkVehicle& craft);
  void begin_pursuit(MavlinkVehicle& craft);
  base::Task<> welcome();
  base::Task<> pursue(MavlinkVehicle& craft);
  base::Task<bool> stop_once(MavlinkVehicle& craft);
  /// Given up to an operator or a pilot.
  [[nodiscard]] bool is_left(MavlinkVehicle const& craft) const;
  [[nodiscard]] vehicle::StopOutcome& outcome(MavlinkVehicle const& craft);
  void tell(MavlinkVehicle const& craft, std::string detail);

  Fleet& fleet_;
  std::function<void()> changed_;
  base::Logger log_;
  vehicle::EmergencyStop state_;
  std::map<vehicle::VehicleId, Pursuit> pursuits_;
  base::Task<> welcome_;
};

}  // namespace lapwing::fleet
