#include <cmath>

#include <fmt/format.h>

#include "plan/performance.hpp"
#include "plan/plausibility/internal/look.hpp"
#include "plan/plausibility/judge.hpp"

/// Commands by hand. What is typed or clicked in a hurry is refused sooner than what was drawn at a desk, and a refusal
/// costs nothing but saying it again.
namespace lapwing::plan::plausibility {

using internal::distance_text;
using internal::place_text;

namespace {

void judge_height(double height_m, Situation const& situation, Limits const& limits, Findings& out) {
  constexpr double on_the_ground_m = 1.0;
  if (!flies(situation.family)) return;
  if (height_m < on_the_ground_m)
    out.push_back({.rule = Rule::below_ground,
                   .what = fmt::format("{:.1f} m is {} the ground of {}'s home", height_m,
                                       height_m < 0.0 ? "below" : "on", situation.vehicle),
                   .meant = "heights count upwards from home"});
  if (height_m > limits.ceiling_m) {
    bool const is_sea = situation.home && situation.home->alt_m > 50.0 && height_m > situation.home->alt_m &&
                        height_m - situation.home->alt_m <= limits.ceiling_m;
    out.push_back(
        {.rule = Rule::ceiling,
         .what = fmt::format("{:.0f} m above home is above the ceiling of {:.0f} m", height_m, limits.ceiling_m),
         .meant = is_sea ? fmt::format("above sea level? home is at {:.0f} m, heights count from there",
                                       situation.home->alt_m)
                         : ""});
  }
}

void judge_distance(GoTo const& command, Situation const& situation, Limits const& limits, Findings& out) {
  auto const from = situation.position ? situation.position : situation.home;
  if (!from) return;
  double const most_m = internal::go_to_distance_m(limits, situation.family);
  double const distance_m = geo::surface_distance_m(*from, command.place);
  if (distance_m > most_m) {
    out.push_back({.rule = Rule::too_far,
                   .what = fmt::format("{} is {} from {}; {} is the most", place_text(command.place),
                                       distance_text(distance_m), situation.vehicle, distance_text(most_m)),
                   .meant = internal::probable_place(command.place, *from, most_m)});
    return;
  }
  auto const lasts = internal::endurance(situation, limits);
  if (!lasts) return;
  double const way_s = distance_m / performance_of(situation.family).cruise_m_s;
  double const back_m = situation.home ? geo::surface_distance_m(command.place, *situation.home) : distance_m;
  double const back_s = way_s + back_m / performance_of(situation.family).cruise_m_s;
  double const lasts_s = base::to_seconds(*lasts);
  if (back_s <= lasts_s) return;
  bool const is_reached = way_s <= lasts_s;
  out.push_back(
      {.rule = Rule::battery,
       .severity = is_reached ? Severity::warn : Severity::refuse,
       .what = fmt::format("the way there{} takes about {:.0f} min, and the battery lasts about {:.0f} min",
                           is_reached ? " and home" : "", (is_reached ? back_s : way_s) / 60.0, lasts_s / 60.0)});
}

/// A command as a mission of one item, for the rules that look at ways.
Mission as_mission(mavlink::MavCmd command, geo::Wgs84 place, double height_m) {
  mavlink::MissionItem item;
  item.command = command;
  item.frame = mavlink::MavFrame::global_relative_alt;
  item.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = height_m};
  return {.name = {}, .home = std::nullopt, .items = {item}};
}

void judge_fences(internal::Look const& look, Findings& out) {
  Findings found;
  internal::judge_fence(look, found);
  internal::judge_own_fence(look, found);
  for (auto& finding : found) {
    finding.item.reset();
    out.push_back(std::move(finding));
  }
}

void judge_fences(GoTo const& command, Situation const& situation, Limits const& limits, Findings& out) {
  auto const way = as_mission(mavlink::MavCmd::nav_waypoint, command.place, command.height_m.value_or(0.0));
  internal::Look look(way, situation, limits, false);
  look.by_hand = "the place";
  if (look.stops.empty()) return;
  if (!command.height_m) look.stops.front().up_m.reset();
  judge_fences(look, out);
}

void judge_fences_of_take_off(double height_m, Situation const& situation, Limits const& limits, Findings& out) {
  auto const at = situation.position ? situation.position : situation.home;
  if (!at) return;
  auto const way = as_mission(mavlink::MavCmd::nav_takeoff, *at, height_m);
  internal::Look look(way, situation, limits, false);
  look.by_hand = "the take-off";
  judge_fences(look, out);
}

}  // namespace

Findings judge(GoTo const& command, Situation const& situation, Settings const& settings) {
  Findings findings;
  if (internal::is_zero_place(command.place, situation.position)) {
    findings.push_back({.rule = Rule::zero_coordinates,
                        .what = "the place is at latitude 0, longitude 0",
                        .meant = "a coordinate that was never set?"});
  } else {
    judge_distance(command, situation, settings.limits, findings);
  }
  if (command.height_m) judge_height(*command.height_m, situation, settings.limits, findings);
  judge_fences(command, situation, settings.limits, findings);
  return marked(std::move(findings), settings);
}

Findings judge_take_off(double height_m, Situation const& situation, Settings const& settings) {
  Findings findings;
  if (!flies(situation.family)) return findings;
  if (height_m < settings.limits.low_take_off_m)
    findings.push_back({.rule = Rule::take_off_height,
                        .severity = height_m < 1.0 ? Severity::refuse : Severity::warn,
                        .what = fmt::format("a take-off to {:.1f} m hardly leaves the ground", height_m)});
  if (height_m > settings.limits.ceiling_m) judge_height(height_m, situation, settings.limits, findings);
  judge_fences_of_take_off(height_m, situation, settings.limits, findings);
  return marked(std::move(findings), settings);
}

Findings judge_start(std::optional<Mission> const& held, Situation const& situation, Settings const& settings) {
  bool const holds_none = held ? held->items.empty() : situation.items_held == 0;
  if (holds_none)
    return marked({{.rule = Rule::empty_mission,
                    .what = fmt::format("{} holds no mission", situation.vehicle),
                    .meant = "upload one first"}},
                  settings);
  return held ? judge(*held, situation, settings) : Findings{};
}

}  // namespace lapwing::plan::plausibility
