#include <algorithm>

#include <fmt/format.h>

#include "plan/plausibility/internal/look.hpp"

/// Where: home, places, and the way between them.
namespace lapwing::plan::plausibility::internal {

namespace {

/// Further than any field: not this one.
constexpr double another_place_m = 2'000.0;

double distance_from(Look const& look, geo::Wgs84 place) {
  double const from_vehicle_m = geo::surface_distance_m(*look.start, place);
  // A vehicle in the air may be at one end of its field, and its next place at the other.
  bool const is_in_air = look.situation.on_ground == false && look.situation.home;
  return is_in_air ? std::min(from_vehicle_m, geo::surface_distance_m(*look.situation.home, place)) : from_vehicle_m;
}

void judge_zero(Look const& look, Findings& out) {
  constexpr auto meant = "a coordinate that was never set?";
  if (look.mission.home && is_zero_place(*look.mission.home, look.situation.position))
    out.push_back({.rule = Rule::zero_coordinates,
                   .what = fmt::format("home is at latitude 0, longitude 0 ({})", place_text(*look.mission.home)),
                   .meant = meant});
  auto const is_zero = [&](Stop const& stop) { return !stop.is_here && is_zero_place(stop.place, look.start); };
  auto const count = static_cast<std::size_t>(std::ranges::count_if(look.stops, is_zero));
  if (count == 0) return;
  auto const& first = *std::ranges::find_if(look.stops, is_zero);
  out.push_back({.rule = Rule::zero_coordinates,
                 .item = first.item,
                 .what = fmt::format("{}{} is at latitude 0, longitude 0", item_text(first.item), more_text(count - 1)),
                 .meant = meant});
}

/// The vehicle's home goes where the mission says, and with it every return: it must be where the vehicle stands, or,
/// once it is away, where it came from.
void judge_home(Look const& look, Findings& out) {
  auto const& home = look.mission.home;
  auto const& now = look.situation;
  if (!home || !now.position || is_zero_place(*home, now.position)) return;
  double const from_vehicle_m = geo::surface_distance_m(*home, *now.position);
  double const from_own_m = now.home ? geo::surface_distance_m(*home, *now.home) : from_vehicle_m;
  if (std::min(from_vehicle_m, from_own_m) <= look.limits.home_moved_m) return;
  bool const stands = now.on_ground.value_or(!now.home);
  auto const& from = stands || !now.home ? *now.position : *now.home;
  double const moved_m = geo::surface_distance_m(*home, from);
  auto meant =
      probable_place(*home, from, std::max(look.limits.home_moved_m, mission_distance_m(look.limits, now.family)));
  if (meant.empty() && moved_m > another_place_m) meant = "this looks like the plan of another place";
  if (meant.empty()) meant = "every return would go there: start there, or give the place where it stands";
  out.push_back({.rule = Rule::home_moved,
                 .what = fmt::format("home would be moved {} from where {} {} ({}) to {}", distance_text(moved_m),
                                     now.vehicle, stands ? "stands" : "has it", place_text(from), place_text(*home)),
                 .meant = std::move(meant)});
}

/// False when the place says enough about itself.
bool is_judged(Look const& look, Stop const& stop) {
  return !stop.is_here && !is_zero_place(stop.place, look.start);
}

void judge_distance(Look const& look, Findings& out) {
  if (!look.start) return;
  double const most_m = look.farthest_m();
  auto const is_far = [&](Stop const& stop) {
    return is_judged(look, stop) && distance_from(look, stop.place) > most_m;
  };
  auto const count = static_cast<std::size_t>(std::ranges::count_if(look.stops, is_far));
  if (count == 0) return;
  auto const& first = *std::ranges::find_if(look.stops, is_far);
  auto meant = probable_place(first.place, *look.start, most_m);
  if (meant.empty() && look.home && *look.home != *look.start) meant = probable_place(first.place, *look.home, most_m);
  if (meant.empty() && !look.is_alone) meant = "the plan of another place, or a wrong digit?";
  auto const whose = look.is_alone ? (look.mission.home ? "home" : "the first place") : look.situation.vehicle;
  out.push_back({.rule = Rule::too_far,
                 .item = first.item,
                 .what = fmt::format("{}{} at {} is {} from {}; {} is the most", item_text(first.item),
                                     more_text(count - 1), place_text(first.place),
                                     distance_text(distance_from(look, first.place)), whose, distance_text(most_m)),
                 .meant = std::move(meant)});
}

/// Between places that are each not too far.
void judge_legs(Look const& look, Findings& out) {
  double const most_m = look.farthest_m();
  Stop const* last = nullptr;
  for (auto const& stop : look.stops) {
    if (!is_judged(look, stop) || stop.command == mavlink::MavCmd::do_set_home) continue;
    if (look.start && distance_from(look, stop.place) > most_m) continue;
    double const leg_m = last ? geo::surface_distance_m(last->place, stop.place) : 0.0;
    if (leg_m > most_m) {
      out.push_back({.rule = Rule::too_far,
                     .item = stop.item,
                     .what = fmt::format("{} is {} from {}; {} is the most", item_text(stop.item), distance_text(leg_m),
                                         item_text(last->item), distance_text(most_m)),
                     .meant = probable_place(stop.place, last->place, most_m)});
      return;
    }
    last = &stop;
  }
}

}  // namespace

void judge_where(Look const& look, Findings& out) {
  judge_zero(look, out);
  judge_home(look, out);
  judge_distance(look, out);
  judge_legs(look, out);
}

}  // namespace lapwing::plan::plausibility::internal
