#include "fleet/control/goal.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "fleet/actions/operator_actions.hpp"
#include "fleet/actions/vehicle_actions.hpp"
#include "fleet/state/failsafe_reason.hpp"
#include "mavlink/wire/modes.hpp"
#include "plan/performance.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::Duration;
using base::TimePoint;
using mavlink::ModeRole;
using vehicle::Action;
using vehicle::Autopilot;
using vehicle::Family;
using Kind = Standing::Kind;

namespace {

constexpr Duration reason_wait = 500ms;  // a heartbeat may come before the text that explains it
constexpr double off_the_ground_m = 0.5;
constexpr double rest_m_s = 0.7;
constexpr double level_m_s = 0.5;
constexpr double jumped_m = 20.0;  // from one target to another

bool circles(Family family) {
  return family == Family::plane || family == Family::vtol;
}

/// Within that of a place a vehicle is there: copters stop at it, ground vehicles within their way-point radius, planes
/// circle it.
double arrival_m(Family family) {
  if (circles(family)) return 120.0;
  return family == Family::copter ? 3.0 : 5.0;
}

std::optional<std::uint32_t> mode_of(MavlinkVehicle const& craft, vehicle::VehicleCommand const& command) {
  auto const role = [&](ModeRole wanted) {
    return mavlink::mode_for(craft.state.autopilot, craft.state.family, wanted);
  };
  switch (command.action) {
    case Action::arm:
    case Action::disarm: return std::nullopt;
    case Action::take_off: return take_off_mode(craft).or_else([&] { return role(ModeRole::guided); });
    case Action::land: return role(ModeRole::land);
    case Action::return_home: return role(ModeRole::rtl);
    case Action::hold:
    case Action::pause_mission: return role(ModeRole::hold);
    case Action::go_to: return role(ModeRole::guided).or_else([&] { return role(ModeRole::hold); });  // PX4 holds there
    case Action::set_mode: return mavlink::mode_number(craft.state.autopilot, craft.state.family, command.mode);
    case Action::start_mission:
    case Action::resume_mission: return role(ModeRole::mission);
  }
  return std::nullopt;
}

std::string metres(double value_m) {
  if (value_m >= 999.5) return fmt::format("{:.1f} km", value_m / 1000.0);
  return fmt::format("{:.0f} m", value_m);
}

std::string in_mode(MavlinkVehicle const& craft) {
  return fmt::format("it is in {}", mode_name(craft, craft.heard->custom_mode));
}

std::optional<double> speed_m_s(MavlinkVehicle const& craft) {
  auto const& velocity = craft.state.motion.velocity_m_s.value;
  if (!velocity) return std::nullopt;
  return std::hypot(velocity->north, velocity->east);
}

/// Who or what put the vehicle into the mode that it shows now.
std::string change_of_mode(MavlinkVehicle const& craft, TimePoint now) {
  constexpr Duration goes_before = 2s;
  auto const what = fmt::format("mode changed to {}", mode_name(craft, craft.heard->custom_mode));
  if (auto const failsafe = recent_failsafe(craft.state, now); !failsafe.empty())
    return fmt::format("{}: {}", what, failsafe);
  auto const& foreign = craft.state.foreign_change;
  bool const is_told = foreign.value && foreign.heard + goes_before >= craft.heard->mode_changed;
  return is_told ? fmt::format("{} ({})", what, *foreign.value) : what;
}

}  // namespace

Goal::Goal(MavlinkVehicle const& craft, vehicle::VehicleCommand command, TimePoint given)
    : command_(std::move(command)),
      since_(given),
      mode_(mode_of(craft, command_)),
      start_height_m_(craft.state.motion.relative_alt_m.value) {
  bool const climbs_to_its_own = command_.action == Action::take_off && take_off_mode(craft);
  bool const is_px4 = craft.state.autopilot == Autopilot::px4;
  if (climbs_to_its_own && is_px4)
    mode_after_ = mavlink::mode_for(craft.state.autopilot, craft.state.family, ModeRole::hold);
  if (climbs_to_its_own || !plan::flies(craft.state.family)) return;
  height_wanted_m_ = command_.height_m;
  if (command_.action == Action::go_to && !height_wanted_m_) height_wanted_m_ = start_height_m_;
}

void Goal::acknowledge(TimePoint now) {
  since_ = now;
  has_been_in_mode_ = has_been_armed_ = heads_there_ = false;
  nearing_.reset();
  at_rest_since_.reset();
  level_since_.reset();
}

Duration Goal::patience() const {
  return command_.action == Action::take_off ? 20s : 10s;  // motors spool up, planes are thrown
}

Standing Goal::look(MavlinkVehicle const& craft, TimePoint now) {
  note(craft, now);
  switch (command_.action) {
    case Action::arm:
    case Action::disarm: return arming(craft);
    case Action::set_mode:
    case Action::start_mission:
    case Action::resume_mission: return mode(craft);
    case Action::hold:
    case Action::pause_mission: return holding(craft);
    case Action::take_off: return take_off(craft, now);
    case Action::land: return landing(craft, now);
    case Action::return_home: return return_home(craft, now);
    case Action::go_to: return go_to(craft, now);
  }
  return {};
}

// ---- what was heard

void Goal::note(MavlinkVehicle const& craft, TimePoint now) {
  auto const& state = craft.state;
  if (is_news(state.links.heartbeat_heard)) {
    has_been_in_mode_ = has_been_in_mode_ || is_in_mode(craft);
    has_been_armed_ = has_been_armed_ || craft.heard->is_armed;
  }
  if (!state.motion.velocity_m_s.value || !is_news(state.motion.velocity_m_s.heard)) return;
  bool const is_level = std::abs(state.motion.velocity_m_s.value->down) < level_m_s;
  bool const is_at_rest = is_level && speed_m_s(craft).value_or(0.0) < rest_m_s;
  if (!is_level) level_since_.reset();
  if (!is_at_rest) at_rest_since_.reset();
  if (is_level && !level_since_) level_since_ = now;
  if (is_at_rest && !at_rest_since_) at_rest_since_ = now;
}

bool Goal::is_in_mode(MavlinkVehicle const& craft) const {
  return is_news(craft.state.links.heartbeat_heard) &&
         (!mode_ || craft.heard->custom_mode == *mode_ || craft.heard->custom_mode == mode_after_);
}

std::string Goal::ended_by(MavlinkVehicle const& craft, TimePoint now) const {
  if (!is_news(craft.state.links.heartbeat_heard)) return {};
  if (has_been_armed_ && !craft.heard->is_armed) return "disarmed";
  if (!has_been_in_mode_ || is_in_mode(craft) || now - craft.heard->mode_changed < reason_wait) return {};
  return change_of_mode(craft, now);
}

std::optional<double> Goal::height_m(MavlinkVehicle const& craft) const {
  auto const& height = craft.state.motion.relative_alt_m;
  return is_news(height.heard) ? height.value : std::nullopt;
}

std::optional<double> Goal::distance_m(MavlinkVehicle const& craft, geo::Wgs84 const& place) const {
  auto const& position = craft.state.motion.position;
  if (!position.value || !is_news(position.heard)) return std::nullopt;
  return geo::surface_distance_m(*position.value, place);
}

bool Goal::has_come_to_rest(MavlinkVehicle const& craft, TimePoint now, Duration time) const {
  return craft.state.motion.velocity_m_s.known() && at_rest_since_ && now - *at_rest_since_ >= time;
}

bool Goal::is_down(MavlinkVehicle const& craft) const {
  auto const& landed = craft.state.motion.landed;
  bool const stands = !landed.value || (*landed.value && is_news(landed.heard));
  return is_news(craft.state.links.heartbeat_heard) && !craft.heard->is_armed && stands;
}

// ---- by what is wanted

Standing Goal::arming(MavlinkVehicle const& craft) const {
  bool const wanted = command_.action == Action::arm;
  bool const shows = is_news(craft.state.links.heartbeat_heard) && craft.heard->is_armed == wanted;
  if (shows) return {Kind::reached, mode_name(craft, craft.heard->custom_mode)};
  return {Kind::unseen, wanted ? "it does not report armed" : "it still reports armed"};
}

Standing Goal::mode(MavlinkVehicle const& craft) const {
  bool const moves = command_.action != Action::set_mode;
  if (is_in_mode(craft) && (craft.heard->is_armed || !moves))
    return {Kind::reached, mode_name(craft, craft.heard->custom_mode)};
  return {Kind::unseen, in_mode(craft)};
}

Standing Goal::holding(MavlinkVehicle const& craft) const {
  constexpr double drifts_m_s = 1.5;
  if (!is_in_mode(craft)) return {Kind::unseen, in_mode(craft)};
  auto const name = mode_name(craft, craft.heard->custom_mode);
  auto const family = craft.state.family;
  auto const speed = speed_m_s(craft);
  bool const is_afloat = family == Family::boat || family == Family::sub;
  bool const cannot_stand = circles(family) || !speed || !craft.heard->is_armed;
  if (cannot_stand) return {Kind::reached, name};
  bool const stands = is_news(craft.state.motion.velocity_m_s.heard) && *speed < (is_afloat ? drifts_m_s : rest_m_s);
  if (stands) return {Kind::reached, fmt::format("{}, stands", name)};
  return {Kind::under_way, fmt::format("{}, still {:.1f} m/s", name, *speed)};
}

Standing Goal::take_off(MavlinkVehicle const& craft, TimePoint now) const {
  constexpr Duration is_there = 3s;
  auto const height = height_m(craft);
  bool const is_own_height = take_off_mode(craft).has_value();
  double const wanted_m = height_wanted_m_.value_or(usual_take_off_height_m);
  auto const at = !height         ? std::string("height not told")
                  : is_own_height ? fmt::format("at {:.0f} m, to the height of its own setting", *height)
                                  : fmt::format("at {:.0f} of {:.0f} m", *height, wanted_m);
  if (auto const end = ended_by(craft, now); !end.empty()) return {Kind::cut_short, fmt::format("{}, {}", end, at)};
  bool const rose = height && *height > start_height_m_.value_or(0.0) + off_the_ground_m;
  bool const flies = craft.state.motion.landed.value == false && is_news(craft.state.motion.landed.heard);
  if (!rose && !flies) return {Kind::unseen, "it has not left the ground"};
  if (!height) return {Kind::under_way, at};
  if (is_own_height) {
    bool const has_levelled = rose && level_since_ && now - *level_since_ >= is_there;
    bool const has_ended = has_been_in_mode_ && mode_after_ && craft.heard->custom_mode == *mode_after_;
    if (has_levelled || has_ended) return {Kind::reached, fmt::format("at {:.0f} m", *height)};
    return {Kind::under_way, at};
  }
  double const tolerance_m = std::max(0.5, 0.03 * wanted_m);
  double const left_m = wanted_m - *height;
  if (left_m <= tolerance_m && has_been_armed_) return {Kind::reached, fmt::format("at {:.0f} m", *height)};
  return {Kind::under_way, at, std::max(0.0, left_m)};
}

Standing Goal::landing(MavlinkVehicle const& craft, TimePoint now) const {
  if (is_down(craft)) return {Kind::reached, "on the ground, motors off"};
  bool const stands = craft.state.motion.landed.value == true && is_news(craft.state.motion.landed.heard);
  bool const has_left = has_been_in_mode_ && !is_in_mode(craft) && now - craft.heard->mode_changed >= reason_wait;
  if (has_left) return {Kind::cut_short, change_of_mode(craft, now)};
  if (!has_been_in_mode_) return {Kind::unseen, in_mode(craft)};
  if (stands) return {Kind::under_way, "on the ground, motors still on"};
  auto const height = height_m(craft);
  if (!height) return {Kind::under_way, "sinks"};
  return {Kind::under_way, fmt::format("at {:.0f} m", *height), std::max(0.0, *height)};
}

Standing Goal::return_home(MavlinkVehicle const& craft, TimePoint now) const {
  constexpr Duration stays = 15s;  // ArduPilot waits 5 s above home before it sinks
  constexpr double near_home_m = 10.0;
  auto const& state = craft.state;
  auto const left_m = state.motion.home.value ? distance_m(craft, *state.motion.home.value) : std::nullopt;
  auto const from = left_m ? fmt::format(", {} from home", metres(*left_m)) : std::string();
  bool const is_near = !left_m || *left_m <= near_home_m;
  bool const can_fly = plan::flies(state.family);
  bool const has_ended = can_fly && is_down(craft);
  if (has_ended) return {is_near ? Kind::reached : Kind::cut_short, fmt::format("on the ground, motors off{}", from)};
  if (has_been_armed_ && !craft.heard->is_armed && !is_near) return {Kind::cut_short, fmt::format("disarmed{}", from)};
  if (has_been_in_mode_ && !is_in_mode(craft)) {
    if (now - craft.heard->mode_changed >= reason_wait) return {Kind::cut_short, change_of_mode(craft, now) + from};
  } else if (!has_been_in_mode_) {
    return {Kind::unseen, in_mode(craft)};
  }
  auto const height = can_fly ? height_m(craft) : std::nullopt;
  if (circles(state.family) && left_m && *left_m <= arrival_m(state.family)) return {Kind::reached, "circles home"};
  bool const rests = has_come_to_rest(craft, now, can_fly ? stays : 2s);
  if (is_near && rests) return {Kind::reached, height ? fmt::format("above home at {:.0f} m", *height) : "at home"};
  auto const at = height ? fmt::format(", at {:.0f} m", *height) : std::string();
  return {Kind::under_way, (left_m ? metres(*left_m) + " from home" : "on its way") + at, left_m};
}

Standing Goal::go_to(MavlinkVehicle const& craft, TimePoint now) {
  auto const& state = craft.state;
  auto const left_m = distance_m(craft, *command_.place);
  auto const to_go = left_m ? metres(*left_m) + " to go" : std::string("position not told");
  if (auto const end = ended_by(craft, now); !end.empty()) return {Kind::cut_short, fmt::format("{}, {}", end, to_go)};
  auto const& target = state.mission.position_target;
  bool const tells_target = target.value && is_news(target.heard) && has_been_in_mode_;
  double const off_m = tells_target ? geo::surface_distance_m(*target.value, *command_.place) : 0.0;
  if (heads_there_ && off_m > jumped_m)
    return {Kind::cut_short, fmt::format("it was sent somewhere else, {}", to_go), left_m};
  if (!left_m) return {Kind::unseen, to_go};
  if (!nearing_) nearing_ = Nearing{*left_m, *left_m, now};
  if (*left_m < nearing_->nearest_m - 1.0) nearing_->nearest_m = *left_m, nearing_->nearest_at = now;
  bool const comes_nearer = nearing_->first_m - *left_m > std::max(3.0, 0.02 * nearing_->first_m);
  bool const is_there = *left_m <= arrival_m(state.family);
  heads_there_ = heads_there_ || (tells_target && off_m <= jumped_m) || (!tells_target && (comes_nearer || is_there));
  if (!has_been_in_mode_) return {Kind::unseen, in_mode(craft)};
  if (!heads_there_ && tells_target)
    return {Kind::unseen, fmt::format("it heads for a place {} from there", metres(off_m))};
  if (!heads_there_) return {Kind::unseen, "it does not come nearer"};
  return arrival(craft, now, *left_m);
}

Standing Goal::arrival(MavlinkVehicle const& craft, TimePoint now, double left_m) const {
  constexpr Duration stuck = 20s;
  constexpr double widest_circle_m = 500.0;
  auto const& state = craft.state;
  bool const is_there = left_m <= arrival_m(state.family);
  auto const height = height_wanted_m_ ? height_m(craft) : std::nullopt;
  double const climb_m = height ? *height_wanted_m_ - *height : 0.0;
  double const tolerance_m = circles(state.family) ? 15.0 : std::max(1.5, 0.05 * height_wanted_m_.value_or(0.0));
  bool const is_high_enough = std::abs(climb_m) <= tolerance_m;
  bool const circles_it = circles(state.family) && left_m < widest_circle_m && nearing_->no_nearer_for(now) > stuck;
  if ((is_there || circles_it) && is_high_enough)
    return {Kind::reached, circles(state.family) ? fmt::format("circles it, {} away", metres(left_m)) : "there"};
  double const way_m = std::hypot(left_m, climb_m);
  if (is_there)
    return {Kind::under_way, fmt::format("{} to {}", metres(std::abs(climb_m)), climb_m > 0 ? "climb" : "sink"), way_m};
  bool const is_stuck = nearing_->no_nearer_for(now) > stuck && left_m > nearing_->nearest_m - 1.0;
  auto const since = is_stuck ? fmt::format(", no nearer for {:.0f} s", base::to_seconds(nearing_->no_nearer_for(now)))
                              : std::string();
  return {Kind::under_way, metres(left_m) + " to go" + since, way_m};
}

}  // namespace lapwing::fleet
