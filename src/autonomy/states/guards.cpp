#include "autonomy/states/guards.hpp"

#include <fmt/format.h>

namespace lapwing::autonomy::guards {

namespace {

using Objection = std::optional<std::string>;

Objection killed(Situation const& s) {
  if (s.memory.is_killed) return "Kill stops the motors: wait until the drone is disarmed";
  return std::nullopt;
}

Objection battery_too_low(Situation const& s) {
  auto const& flight = s.told.flight;
  if (!flight || !flight->battery) return "the battery's charge is not known: wait for the flight controller";
  if (*flight->battery > s.options.least_battery_to_arm) return std::nullopt;
  return fmt::format("the battery has {:.0f} %, and more than {:.0f} % are needed: charge it", *flight->battery * 100,
                     s.options.least_battery_to_arm * 100);
}

Objection not_ready_to_arm(Situation const& s) {
  if (auto no = killed(s)) return no;
  if (auto no = battery_too_low(s)) return no;
  if (auto no = process_failure(s)) return no;
  if (is_in_the_air(s)) return "it is flying already: Land first";
  // Near the ground it may still be flying, and would stop there in the middle of its landing.
  if (is_armed(s) && is_coming_down(s)) return "it is landing: wait until it is disarmed";
  auto const& flight = *s.told.flight;
  if (!flight.prearm_ok) return "the flight controller's own checks fail: see its messages";
  if (flight.gps_fix < gps_fix_3d) return fmt::format("there is no GPS fix (type {}): wait for one", flight.gps_fix);
  return std::nullopt;
}

Objection not_ready_to_take_off(Situation const& s) {
  if (!is_armed(s)) return "it is not armed yet: wait until it is";
  if (!is_in_mode(s, guided))
    return fmt::format("the flight controller is in mode {}: wait for {}", s.told.flight->mode, guided);
  return battery_too_low(s);
}

Objection not_armed(Situation const& s) {
  if (auto no = killed(s)) return no;
  if (!is_armed(s)) return "it is not armed";
  return std::nullopt;
}

Objection not_in_the_air(Situation const& s) {
  if (is_in_the_air(s)) return std::nullopt;
  return "it is too low to break off the landing";
}

Objection flown_by_hand(Situation const& s) {
  if (!s.memory.is_flown_by_hand || !s.told.flight) return std::nullopt;
  return fmt::format("somebody else flies it in mode {}: he has to give it back in mode {} first", s.told.flight->mode,
                     guided);
}

Objection no_place_by_map(Situation const& s) {
  if (auto no = flown_by_hand(s)) return no;
  auto const& move = std::get<command::AutonomousMove>(*s.command);
  auto const sound = check_place(move.place, s.options.places, s.told.lot);
  if (sound) return std::nullopt;
  return fmt::format("{}: {}", sound.error().message, sound.error().hint);
}

Objection no_place_on_globe(Situation const& s) {
  if (auto no = flown_by_hand(s)) return no;
  auto const* const flight = heard_flight(s);
  if (flight == nullptr || !flight->position || !flight->local) return "the drone does not know yet where it is";
  geo::Point<ArmingFrame> const here(flight->local->x(), flight->local->y());
  auto const& wanted = std::get<command::CompulsiveMove>(*s.command).place;
  auto const* const local = std::get_if<geo::Point<ArmingFrame>>(&wanted);
  auto place = local != nullptr ? base::Result<geo::Point<ArmingFrame>>(*local)
                                : in_arming_frame(std::get<geo::Wgs84>(wanted), *flight->position, here);
  auto const sound = place ? check_place(*place, s.options.places, std::nullopt) : std::unexpected(place.error());
  if (sound) return std::nullopt;
  return fmt::format("{}: {}", sound.error().message, sound.error().hint);
}

}  // namespace

Guard const ready_to_arm{"battery above 20 %, processes well, pre-arm checks pass, GPS fix", not_ready_to_arm};
Guard const ready_to_take_off{"armed in GUIDED, battery above 20 %", not_ready_to_take_off};
Guard const armed{"armed", not_armed};
Guard const in_the_air{"in the air", not_in_the_air};
Guard const in_our_hands{"not flown by hand", flown_by_hand};
Guard const place_by_map{"not flown by hand, place plausible", no_place_by_map};
Guard const place_on_globe{"not flown by hand, place plausible", no_place_on_globe};

}  // namespace lapwing::autonomy::guards
