#include "autonomy/states/situation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace lapwing::autonomy {

namespace {

/// Modes in which ArduPilot comes down by itself, as MAVROS names them.
constexpr std::array<std::string_view, 4> descent_modes{return_home, land_here, "SMART_RTL", "AUTO RTL"};

bool is_over(std::optional<base::TimePoint> const& since, base::Duration patience, base::TimePoint now) {
  return since && now - *since > patience;
}

std::optional<std::string> flight_failure(Situation const& s) {
  auto const& flight = s.told.flight;
  if (!flight) return "the flight controller has not been heard";
  if (flight->silence > s.options.flight_controller_lost)
    return fmt::format("the flight controller has been silent for {:.1f} s", base::to_seconds(flight->silence));
  if (flight->is_critical) return "the flight controller calls its own state critical";
  if (is_over(s.memory.no_place_since, s.options.place_patience, s.now))
    return fmt::format("the drone does not know where it is (GPS fix of type {})", flight->gps_fix);
  if (is_over(s.memory.no_battery_since, s.options.battery_patience, s.now))
    return "the flight controller does not tell the battery's charge any more";
  return std::nullopt;
}

std::optional<WayHome> way_home(Situation const& s) {
  auto const& flight = s.told.flight;
  auto const home = s.memory.home ? s.memory.home : flight ? flight->home : std::nullopt;
  if (!flight || !flight->position || !flight->relative_alt_m || !home) return std::nullopt;
  return WayHome{.distance_m = geo::surface_distance_m(*flight->position, *home),
                 .height_m = *flight->relative_alt_m,
                 .return_height_m = s.memory.heights.desired_m};
}

}  // namespace

FlightController const* heard_flight(Situation const& s) {
  bool const is_heard = s.told.flight && s.told.flight->silence <= s.options.flight_controller_lost;
  return is_heard ? &*s.told.flight : nullptr;
}

bool is_heard_disarmed(Situation const& s) {
  auto const* const flight = heard_flight(s);
  return flight != nullptr && !flight->is_armed;
}

bool is_armed(Situation const& s) {
  return s.told.flight && s.told.flight->is_armed;
}

bool is_in_mode(Situation const& s, std::string_view mode) {
  auto const* const flight = heard_flight(s);
  return flight != nullptr && flight->mode == mode;
}

bool is_coming_down(Situation const& s) {
  auto const* const flight = heard_flight(s);
  return flight != nullptr && std::ranges::find(descent_modes, flight->mode) != descent_modes.end();
}

bool is_link_lost(Situation const& s) {
  return s.told.link.silence > s.options.link_lost;
}

bool is_in_the_air(Situation const& s) {
  auto const& flight = s.told.flight;
  return flight && flight->is_armed && flight->relative_alt_m.value_or(0.0) >= s.options.in_the_air_m;
}

std::optional<std::string> process_failure(Situation const& s) {
  auto const longest = s.options.health_period * s.options.missed_reports;
  for (auto const& process : s.told.processes) {
    if (!process.silence) return fmt::format("{} has not reported yet", process.name);
    if (*process.silence > longest)
      return fmt::format("{} has not reported for {:.1f} s", process.name, base::to_seconds(*process.silence));
    if (!process.is_well)
      return fmt::format("{} has failed{}{}", process.name, process.words.empty() ? "" : ": ", process.words);
  }
  return std::nullopt;
}

std::optional<std::string> failure_of(Situation const& s) {
  if (auto flight = flight_failure(s)) return flight;
  return process_failure(s);
}

double reserve_here(Situation const& s) {
  return reserve(way_home(s), s.told.flight ? s.told.flight->drain : std::nullopt, s.options.reserve);
}

std::optional<base::Duration> flying_time_left(Situation const& s) {
  auto const* const flight = heard_flight(s);
  if (flight == nullptr || !flight->battery || !flight->relative_alt_m) return std::nullopt;
  return flying_time_left(*flight->battery, *flight->relative_alt_m, s.memory.heights.desired_m, flight->drain,
                          s.options.reserve);
}

void tell(Situation& s, std::string text) {
  s.said.error_log.push_back(std::move(text));
}

}  // namespace lapwing::autonomy
