#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "geo/position.hpp"
#include "vehicle/vehicle_id.hpp"

/// What an operator may do with vehicles: commands, the emergency stop, and who is in command. Plain data and one
/// interface, so that whoever shows it needs no protocol.
namespace lapwing::vehicle {

enum class Action {
  arm,
  disarm,
  take_off,
  land,
  return_home,
  hold,  ///< stay here: copter BRAKE, plane LOITER, rover HOLD
  go_to,
  set_mode,
  start_mission,  ///< arms too
  pause_mission,
  resume_mission,
};
[[nodiscard]] std::string_view to_string(Action action);
[[nodiscard]] std::optional<Action> action_from(std::string_view word);
/// Brings the vehicle to rest or home: always let through, whoever is in command.
[[nodiscard]] bool is_stop(Action action);

struct VehicleCommand {
  Action action = Action::hold;
  std::optional<double> height_m = std::nullopt;  ///< above home: of take_off; of go_to, where nothing means "as it is"
  std::optional<geo::Wgs84> place = std::nullopt;  ///< of go_to; its altitude does not count
  std::string mode = {};                           ///< of set_mode: the autopilot's own name
  std::map<std::string, std::string> allow = {};   ///< rules of plausibility that may be broken, with the reasons
};

/// How far a command has come on one vehicle. What a vehicle shows counts only when it was heard after the command and
/// belongs to it alone.
enum class CommandState {
  waiting,     ///< sent, or about to be
  accepted,    ///< the vehicle has acknowledged it
  under_way,   ///< the vehicle shows that it obeys, and what is left
  confirmed,   ///< the vehicle shows that it has done it: it is at the height, at the place, on the ground, in the mode
  refused,     ///< by the vehicle or here
  timed_out,   ///< no answer, or nothing that shows it; corrected when the vehicle shows it late
  expired,     ///< not sent any more: it came too late
  superseded,  ///< a later command or a stop took its place before it was under way
  cut_short,   ///< the same while it was under way, or the vehicle has left off by itself or by another's hand
};
[[nodiscard]] std::string_view to_string(CommandState state);
/// Nothing more is expected of it.
[[nodiscard]] bool is_over(CommandState state);

struct CommandOutcome {
  VehicleId vehicle;
  CommandState state = CommandState::waiting;
  std::string reason = {};            ///< "at 7 of 20 m", "arming refused: ..."
  std::optional<double> left_m = {};  ///< to go or to climb, while it is under way and that is known
  std::string rule = {};              ///< of plausibility that refused it: what `allow` of a command names
};

/// One command as it was given, and what each vehicle made of it.
struct CommandRecord {
  std::uint64_t number = 0;
  VehicleCommand command;
  std::string by;
  base::UtcTime asked{};
  std::vector<CommandOutcome> outcomes = {};
};

/// Makes room for one more: a dozen are kept, and of those of which something is still expected some dozens.
void make_room(std::deque<CommandRecord>& records);

/// What an emergency stop does to a vehicle.
enum class StopAction {
  hold,  ///< flying and swimming machines stay in place; ground vehicles stand and are disarmed
  land,
  return_home,
  terminate,  ///< motors off at once, in the air too
};
[[nodiscard]] std::string_view to_string(StopAction action);
[[nodiscard]] std::optional<StopAction> stop_action_from(std::string_view word);

struct StopOutcome {
  VehicleId vehicle;
  bool is_acknowledged = false;
  bool is_confirmed = false;  ///< by the vehicle's state
  int tries = 0;
  std::string detail = {};  ///< what it does now, or why it is not stopped
};

struct EmergencyStop {
  bool is_latched = false;
  StopAction action = StopAction::hold;
  std::string by = {};
  base::UtcTime since{};
  std::vector<StopOutcome> vehicles = {};  ///< of the last one, latched or not
};

/// Who gives a command, by a name that is his alone: "operator 2", "script".
using Commander = std::string;

/// Commands for several vehicles at once, and who may give them. Implemented by a platform. Thread-bound.
///
/// A vehicle has one commander, or none. Commanding one that nobody commands makes the giver its commander; one that
/// somebody else commands is refused, except for stops and for who takes it over. Nothing here waits: what becomes of a
/// command shows in its record.
class VehicleControl {
 public:
  virtual ~VehicleControl() = default;

  /// Whether the vehicle is one of its own.
  [[nodiscard]] virtual bool has(VehicleId const& id) const = 0;

  /// Gives the command to each vehicle, and returns its number. Errors: invalid_input (nothing to command, or a
  /// command without what it needs). What is wrong with one vehicle shows in its outcome.
  virtual base::Result<std::uint64_t> command(VehicleCommand command, std::span<VehicleId const> vehicles, Commander by,
                                              bool takes_over) = 0;
  /// The latest, oldest first.
  [[nodiscard]] virtual std::deque<CommandRecord> const& commands() const = 0;

  /// Stops every vehicle, those that appear later included, until `release_emergency_stop`. While it is latched no
  /// script runs and nothing that moves a vehicle is sent. Once more with another action: that one from now on.
  /// Without an action: the one that is latched, else the one that the station is set to.
  virtual void emergency_stop(std::optional<StopAction> action, Commander by) = 0;
  virtual void release_emergency_stop(Commander by) = 0;
  [[nodiscard]] virtual EmergencyStop const& emergency() const = 0;

  /// Asks for the command of a vehicle: granted at once when nobody has it, else when its commander yields, is gone, or
  /// lets the time-out pass. Errors: not_found, refused (somebody else asks already).
  virtual base::Result<> request_control(VehicleId const& id, Commander by) = 0;
  /// The commander's answer to the request, or his own wish to be rid of the vehicle. Error: refused (he is not its
  /// commander).
  virtual base::Result<> yield_control(VehicleId const& id, Commander by) = 0;
  virtual base::Result<> keep_control(VehicleId const& id, Commander by) = 0;
  /// This commander will not come back: his vehicles are nobody's, or whoever's has asked.
  virtual void forget(Commander const& by) = 0;

  /// Grows with every change of `commands` and `emergency`.
  [[nodiscard]] virtual std::uint64_t revision() const = 0;
};

}  // namespace lapwing::vehicle
