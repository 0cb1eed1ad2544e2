#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "autonomy/states/asking.hpp"
#include "autonomy/states/diagnostics.hpp"
#include "autonomy/states/transitions.hpp"

// What each state does when it begins and in each frame. Nothing here waits: what takes a while is asked for again in
// later frames, and given up by events.

namespace lapwing::autonomy {

namespace {

void nothing(Situation&) {}

// ---- on the ground

void process_idle(Situation& s) {
  insist_on_kill(s);
}

void enter_configure(Situation& s) {
  auto const& wanted = std::get<command::Configure>(*s.command).heights;
  if (auto const fault = heights_fault(wanted)) {
    s.memory.user_error = UserError::height_params_invalid;
    tell(s, fmt::format("the heights are not taken: {}", *fault));
    return;
  }
  s.memory.user_error = UserError::none;
  s.memory.heights = wanted;
  s.said.to_save = wanted;
}

void enter_arm(Situation& s) {
  s.memory.was_armed = false;
  s.memory.unarmed_since = s.now;
  s.memory.disarms_until.reset();
  s.memory.next_arm_request = s.now;
  want_mode(s);
}

/// Home is where the flight controller will return to: its own word for it, else the place where it is armed.
void save_home(Situation& s, FlightController const& flight) {
  if (flight.home)
    s.memory.home = flight.home;
  else if (!s.memory.home)
    s.memory.home = flight.position;
}

void process_arm(Situation& s) {
  auto const* const flight = heard_flight(s);
  if (flight == nullptr) return;
  save_home(s, *flight);
  if (!s.memory.home) return;
  if (flight->mode != guided) s.memory.mode.is_seen = false;
  ask_for_mode(s, guided);
  if (flight->is_armed) {
    s.memory.was_armed = true;
    s.memory.unarmed_since = s.now;
    return;
  }
  bool const may_ask = s.memory.arm_requests < s.options.most_arm_requests && s.now >= s.memory.next_arm_request;
  if (!may_ask || flight->mode != guided) return;
  ++s.memory.arm_requests;
  s.memory.next_arm_request = s.now + s.options.arm_repeat;
  s.said.requests.emplace_back(request::Arm{.is_to_arm = true});
}

// ---- in the air

double height_m(Situation const& s) {
  return s.told.flight ? s.told.flight->relative_alt_m.value_or(0.0) : 0.0;
}

void ask_for_takeoff(Situation& s) {
  if (s.now < s.memory.next_takeoff || height_m(s) >= s.options.in_the_air_m) return;
  s.memory.next_takeoff = s.now + s.options.repeat;
  s.said.requests.emplace_back(request::Takeoff{s.memory.heights.desired_m});
}

void enter_takeoff(Situation& s) {
  want_mode(s);
  ask_for_mode(s, guided);
  s.memory.next_takeoff = height_m(s) > s.options.already_up_m ? base::TimePoint::max() : s.now;
  ask_for_takeoff(s);
}

void process_takeoff(Situation& s) {
  ask_for_mode(s, guided);
  ask_for_takeoff(s);
}

/// Without a setpoint of its own the flight controller would fly on to the last one.
void hold(Situation& s) {
  if (!s.memory.hold) s.memory.hold = place_to_hold(s);
  if (s.memory.hold) s.said.requests.emplace_back(request::LocalSetpoint{*s.memory.hold});
}

void begin_flight(Situation& s) {
  s.memory.hold = place_to_hold(s);
  s.memory.next_setpoint = s.now;
  s.memory.target.reset();
  s.memory.is_agreed = false;
  s.memory.has_refused_setpoint = false;
  if (s.memory.is_flown_by_hand) return;
  want_mode(s);
  ask_for_mode(s, guided);
}

void process_hover(Situation& s) {
  if (s.memory.is_flown_by_hand) {
    if (!is_in_mode(s, guided)) return;
    s.memory.is_flown_by_hand = false;
    s.memory.hold = place_to_hold(s);
  }
  ask_for_mode(s, guided);
  if (is_in_mode(s, guided) && is_setpoint_due(s)) hold(s);
}

void enter_location_error(Situation& s) {
  begin_flight(s);
  s.memory.user_error = UserError::desired_location_out_of_bounds;
  tell(s, "the wanted place is not in the parking lot: the drone waits here for another command");
}

void enter_no_lot(Situation& s) {
  begin_flight(s);
  s.memory.user_error = UserError::no_lot_detected;
  tell(s, "no parking lot is seen any more: the drone waits here for another command");
}

/// What the planner wants, when it makes sense and is fresh. A refusal is told once.
std::optional<request::LocalSetpoint> planner_setpoint(Situation& s) {
  auto const& [place, yaw_rad, at] = *s.told.setpoint;
  if (s.now - at > s.options.setpoint_lasts) return std::nullopt;
  auto sound = check_place({place.x(), place.y()}, s.options.places, std::nullopt);
  if (sound) sound = check_height(place.z(), s.memory.heights);
  if (sound) return request::LocalSetpoint{place, yaw_rad};
  if (!s.memory.has_refused_setpoint)
    tell(s, fmt::format("the planner's setpoint is refused: {}: the drone waits here", sound.error().message));
  s.memory.has_refused_setpoint = true;
  return std::nullopt;
}

void process_explore(Situation& s) {
  ask_for_mode(s, guided);
  if (!s.told.setpoint || !is_in_mode(s, guided) || !is_setpoint_due(s)) return;
  auto const wanted = planner_setpoint(s);
  if (!wanted) {
    hold(s);
    return;
  }
  s.memory.hold.reset();  // the next wait is where it will be then
  s.said.requests.emplace_back(*wanted);
}

request::LocalSetpoint wanted_pose(Situation const& s) {
  auto const& place = std::get<geo::Point<ArmingFrame>>(s.memory.target->place);
  return {geo::Point3<ArmingFrame>(place.x(), place.y(), s.memory.heights.desired_m), s.memory.target->yaw_rad};
}

/// It holds where it is until the planner has said that the place is in the lot.
void process_move(Situation& s) {
  ask_for_mode(s, guided);
  auto const& verdict = s.told.place;
  if (verdict && verdict->is_in_lot && verdict->at - s.memory.entered >= s.options.verdict_settles)
    s.memory.is_agreed = true;
  if (!is_setpoint_due(s)) return;
  s.said.wanted_place = wanted_pose(s);
  if (!is_in_mode(s, guided)) return;
  if (s.memory.is_agreed)
    s.said.requests.emplace_back(wanted_pose(s));
  else
    hold(s);
}

void enter_move(Situation& s) {
  auto const& move = std::get<command::AutonomousMove>(*s.command);
  begin_flight(s);
  s.memory.target = {move.place, move.yaw_rad};
  process_move(s);
}

void process_compulsive(Situation& s) {
  ask_for_mode(s, guided);
  if (!is_in_mode(s, guided) || !is_setpoint_due(s)) return;
  s.said.requests.emplace_back(request::GlobalSetpoint{std::get<geo::Wgs84>(s.memory.target->place),
                                                       s.memory.heights.desired_m, s.memory.target->yaw_rad});
}

void enter_compulsive(Situation& s) {
  auto const& move = std::get<command::CompulsiveMove>(*s.command);
  begin_flight(s);
  auto const* const local = std::get_if<geo::Point<ArmingFrame>>(&move.place);
  auto const& flight = *s.told.flight;  // the guard has seen that it knows its place
  s.memory.target = {local != nullptr ? on_globe(*local, *flight.position, {flight.local->x(), flight.local->y()})
                                      : std::get<geo::Wgs84>(move.place),
                     move.yaw_rad};
  process_compulsive(s);
}

// ---- down

void enter_descent(Situation& s) {
  want_mode(s);
  s.said.requests.emplace_back(request::ReturnAltitude{s.memory.heights.desired_m});
  ask_to_return(s);
}

void enter_malfunction(Situation& s) {
  tell(s, fmt::format("malfunction: {}", s.memory.reason));
  s.said.diagnostics = diagnostics_text(s);
  enter_descent(s);
}

constexpr std::string_view hovers = "mode GUIDED; hold";
constexpr std::string_view asks_again = "ask for RTL again until it is seen, after 5 s for LAND";

using enum State;
constexpr std::array<Behaviour, state_count> behaviours{{
    {idle, "", nothing, "", process_idle},
    {configure, "take and save the heights, or user error Height_Params_Invalid", enter_configure, "", nothing},
    {arm, "", enter_arm, "when the flight controller is heard: save home, ask for GUIDED, then to arm; at most 5 times",
     process_arm},
    {takeoff, "take off to the desired hover height, unless above 5 m", enter_takeoff, "ask again as long as it stands",
     process_takeoff},
    {hover, hovers, begin_flight, "setpoint here; nothing while flown by hand", process_hover},
    {autonomous_explore, "mode GUIDED", begin_flight,
     "the planner's setpoint, when it is fresh and makes sense, else here", process_explore},
    {autonomous_move, "mode GUIDED", enter_move,
     "wanted place to the planner; setpoint here until it agrees, then there at the desired height", process_move},
    {compulsive_move, "mode GUIDED", enter_compulsive, "setpoint there at the desired height", process_compulsive},
    {desired_location_error, "as Hover; user error, message", enter_location_error, "as Hover", process_hover},
    {no_parking_lot_detected, "as Hover; user error, message", enter_no_lot, "as Hover", process_hover},
    {land, "RTL altitude, mode RTL", enter_descent, asks_again, ask_to_return},
    {State::communication_lost, "RTL altitude, mode RTL; no heartbeat", enter_descent, asks_again, ask_to_return},
    {malfunction, "diagnostics to a file, message; RTL altitude, mode RTL", enter_malfunction, asks_again,
     ask_to_return},
}};

}  // namespace

Behaviour const& behaviour_of(State state) {
  return behaviours[static_cast<std::size_t>(state)];
}

}  // namespace lapwing::autonomy
