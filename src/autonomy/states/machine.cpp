#include "autonomy/states/machine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "autonomy/states/asking.hpp"
#include "base/assert.hpp"

namespace lapwing::autonomy {

namespace {

/// Numbers that are none are not known; what the bus brings has them.
Told cleaned(Told told) {
  if (!told.flight) return told;
  auto& flight = *told.flight;
  if (flight.relative_alt_m && !std::isfinite(*flight.relative_alt_m)) flight.relative_alt_m.reset();
  if (flight.local && !flight.local->is_finite()) flight.local.reset();
  if (flight.battery && !(*flight.battery >= 0.0 && *flight.battery <= 1.0)) flight.battery.reset();
  for (auto* const place : {&flight.position, &flight.home})
    if (*place && !(std::isfinite((*place)->lat_rad) && std::isfinite((*place)->lon_rad))) place->reset();
  return told;
}

void begin_or_end(std::optional<base::TimePoint>& since, bool is_so, base::TimePoint now) {
  if (!is_so)
    since.reset();
  else if (!since)
    since = now;
}

void watch_sensors(Situation& s) {
  auto const& flight = s.told.flight;
  bool const knows_place = flight && flight->gps_fix >= gps_fix_3d && flight->position && flight->local;
  begin_or_end(s.memory.no_place_since, flight && !knows_place, s.now);
  begin_or_end(s.memory.no_battery_since, flight && !flight->battery, s.now);
}

void go(Situation& s, Transition const& row) {
  auto& memory = s.memory;
  bool const leaves_error =
      memory.state == State::desired_location_error || memory.state == State::no_parking_lot_detected;
  if (leaves_error) memory.user_error = UserError::none;
  memory.is_flown_by_hand = false;
  if (row.action.act != nullptr) row.action.act(s);
  memory.state = row.next;
  memory.entered = s.now;
  behaviour_of(row.next).enter(s);
}

/// Whether it led anywhere.
bool try_event(Situation& s, Event event) {
  auto const* const row = find_transition(s.memory.state, event);
  if (row == nullptr || !happens(event, s)) return false;
  if (row->guard.objection != nullptr && row->guard.objection(s)) return false;
  go(s, *row);
  return true;
}

bool try_events(Situation& s, Event first, Event last) {
  for (auto i = static_cast<int>(first); i <= static_cast<int>(last); ++i)
    if (try_event(s, static_cast<Event>(i))) return true;
  return false;
}

std::string taken_in(State state) {
  std::string names;
  for (std::size_t i = 0; i < command_count; ++i) {
    auto const name = command_name(i);
    bool const is_taken = std::ranges::any_of(transition_table(), [&](Transition const& row) {
      return row.from.has(state) && is_command(row.event) && to_string(row.event) == name;
    });
    if (is_taken) names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  }
  return names;
}

bool obey(Situation& s, Command const& command) {
  s.command = &command;
  auto const* const row = find_transition(s.memory.state, event_of(command));
  if (row == nullptr) {
    tell(s, fmt::format("{} is not taken in {}, which takes {}", name_of(command), to_string(s.memory.state),
                        taken_in(s.memory.state)));
    return false;
  }
  auto const objection = row->guard.objection != nullptr ? row->guard.objection(s) : std::nullopt;
  if (objection) {
    tell(s, fmt::format("{} is refused: {}", name_of(command), *objection));
    return false;
  }
  go(s, *row);
  return true;
}

bool is_kill(Command const& command) {
  return std::holds_alternative<command::Kill>(command);
}

void kill(Situation& s, Command const& kill_command) {
  obey(s, kill_command);
  for (auto const& command : s.told.commands)
    if (!is_kill(command)) tell(s, fmt::format("{} is overtaken by Kill", name_of(command)));
}

void decide(Situation& s) {
  auto const& commands = s.told.commands;
  if (auto const found = std::ranges::find_if(commands, is_kill); found != commands.end()) {
    kill(s, *found);
    return;
  }
  bool has_moved = try_events(s, first_of_safety, last_of_safety);
  for (auto const& command : commands) has_moved = obey(s, command) || has_moved;
  if (!has_moved) has_moved = try_events(s, first_of_own, last_of_own);
  if (!has_moved) behaviour_of(s.memory.state).process(s);
  insist_on_disarming(s);
}

/// At its period; and at once when the state has changed, for that is what the operator waits for.
bool is_heartbeat_due(Situation& s) {
  bool const has_changed = s.memory.entered == s.now;
  if (s.memory.state == State::communication_lost || (!has_changed && s.now < s.memory.next_heartbeat)) return false;
  s.memory.next_heartbeat = s.now + s.options.heartbeat_period;
  return true;
}

Health health_of(Situation const& s) {
  auto const state = s.memory.state;
  if (state == State::malfunction) return {false, s.memory.reason};
  if (state == State::communication_lost || is_link_lost(s)) return {false, std::string(communication_lost)};
  if (auto failure = failure_of(s)) return {false, *std::move(failure)};
  return {};
}

}  // namespace

Machine::Machine(Options options, HoverHeights heights) : options_(std::move(options)) {
  LAPWING_ASSERT(!heights_fault(heights), heights.min_m, heights.desired_m, heights.max_m);
  memory_.heights = heights;
}

Said Machine::step(Told const& told, base::TimePoint now) {
  auto const sound = cleaned(told);
  Said said;
  Situation s{options_, sound, now, memory_, said};
  watch_sensors(s);
  decide(s);
  auto const* const flight = heard_flight(s);
  bool const tells_height = flight != nullptr && flight->relative_alt_m;
  memory_.has_met_flight_controller = memory_.has_met_flight_controller || tells_height;
  said.state = memory_.state;
  said.user_error = memory_.user_error;
  said.flying_time_left = flying_time_left(s);
  said.health = health_of(s);
  said.sends_heartbeat = is_heartbeat_due(s);
  return said;
}

}  // namespace lapwing::autonomy
