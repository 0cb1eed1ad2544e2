#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "plan/plausibility/internal/look.hpp"

/// Height: of home, of every place, of the take-off.
namespace lapwing::plan::plausibility::internal {

namespace {

using mavlink::MavCmd;

/// What a barometer drifts in a flight.
constexpr double drift_m = 2.0;
/// Lower than this nobody flies from place to place.
constexpr double on_the_ground_m = 1.0;
constexpr double at_home_m = 20.0;

/// For an altitude above sea level that makes more sense as one above the ground.
std::string as_height(double sea_m, double ground_m) {
  return fmt::format("altitudes of scripts are above sea level: {:.0f} m above the ground here is {:.0f}", sea_m,
                     ground_m + sea_m);
}

void judge_home_height(Look const& look, Findings& out) {
  if (!look.mission.home || !look.ground_m || look.is_alone) return;
  double const up_m = look.mission.home->alt_m - *look.ground_m;
  if (std::abs(up_m) <= look.limits.home_height_m) return;
  std::string meant = "is this its altitude above sea level?";
  if (std::abs(look.mission.home->alt_m) <= look.limits.home_height_m)
    meant = fmt::format("it looks like a height above the ground; altitudes of scripts are above sea level: add {:.0f}",
                        *look.ground_m);
  out.push_back({.rule = Rule::home_height,
                 .what = fmt::format("home is given at {:.0f} m above sea level, and the ground on which {} started is "
                                     "at {:.0f} m",
                                     look.mission.home->alt_m, look.situation.vehicle, *look.ground_m),
                 .meant = std::move(meant)});
}

/// True for what the vehicle flies to at that height. Copters come down where they land until they touch the ground,
/// whatever altitude the item has; wings aim at it.
bool is_flown(Look const& look, Stop const& stop) {
  if (stop.command == MavCmd::do_set_home || stop.takes_off() || !stop.up_m) return false;
  bool const is_wing = look.situation.family == vehicle::Family::plane;
  return !stop.lands() || (is_wing && stop.command == MavCmd::nav_land && !stop.is_here);
}

bool is_below(Look const& look, Stop const& stop) {
  return is_flown(look, stop) && *stop.up_m < -(stop.lands() ? look.limits.home_height_m : drift_m);
}

bool is_low(Look const& look, Stop const& stop) {
  if (!is_flown(look, stop) || stop.lands() || stop.is_here || *stop.up_m >= on_the_ground_m) return false;
  return !look.home || geo::surface_distance_m(stop.place, *look.home) > at_home_m;
}

std::string below_meant(Look const& look, Stop const& stop) {
  if (stop.sea_m && look.ground_m && *stop.sea_m > 0.0 && *stop.sea_m < *look.ground_m)
    return as_height(*stop.sea_m, *look.ground_m);
  if (stop.sea_m && look.ground_m) return "altitudes of scripts are above sea level";
  return "heights count upwards from home";
}

void judge_below(Look const& look, Findings& out) {
  auto const below = [&](Stop const& stop) { return is_below(look, stop); };
  auto const low = [&](Stop const& stop) { return is_low(look, stop); };
  if (auto const count = static_cast<std::size_t>(std::ranges::count_if(look.stops, below)); count > 0) {
    auto const& first = *std::ranges::find_if(look.stops, below);
    out.push_back({.rule = Rule::below_ground,
                   .item = first.item,
                   .what = fmt::format("{}{} is {:.0f} m below the ground of home", item_text(first.item),
                                       more_text(count - 1), -*first.up_m),
                   .meant = below_meant(look, first)});
  } else if (auto const at_ground = static_cast<std::size_t>(std::ranges::count_if(look.stops, low)); at_ground > 0) {
    auto const& first = *std::ranges::find_if(look.stops, low);
    out.push_back({.rule = Rule::below_ground,
                   .severity = Severity::warn,
                   .item = first.item,
                   .what = fmt::format("{}{} is at the height of home's ground ({:+.1f} m), away from home",
                                       item_text(first.item), more_text(at_ground - 1), *first.up_m),
                   .meant = "give it a height to fly at"});
  }
}

void judge_take_off_height(Look const& look, Findings& out) {
  constexpr double leaves_m = 0.5;
  if (look.situation.on_ground == false) return;
  auto const found = std::ranges::find_if(look.stops, &Stop::takes_off);
  if (found == look.stops.end() || !found->up_m || *found->up_m >= look.limits.low_take_off_m) return;
  bool const stays = *found->up_m <= leaves_m;
  Finding finding{.rule = Rule::take_off_height,
                  .severity = stays ? Severity::refuse : Severity::warn,
                  .item = found->item,
                  .what = fmt::format("the take-off goes to {:.1f} m above the ground", *found->up_m)};
  if (found->sea_m && look.ground_m)
    finding.what = fmt::format("the take-off goes to {:.0f} m above sea level, and the ground is at {:.0f} m",
                               *found->sea_m, *look.ground_m);
  if (stays && found->sea_m && look.ground_m && *found->sea_m > look.limits.low_take_off_m) {
    bool const is_home_itself = *found->sea_m > *look.ground_m - on_the_ground_m;
    finding.meant = is_home_itself ? "it climbs to the altitude of its place: give that more than home's"
                                   : as_height(*found->sea_m, *look.ground_m);
  }
  out.push_back(std::move(finding));
}

std::string high_meant(Look const& look, Stop const& stop) {
  constexpr double low_enough_m = 200.0;
  if (stop.sea_m || !look.ground_m || *look.ground_m < look.limits.ceiling_m) return {};
  double const as_sea_m = *stop.up_m - *look.ground_m;
  bool const fits = as_sea_m > 0.0 && as_sea_m <= low_enough_m;
  return fits ? "it looks like an altitude above sea level where one above home is meant" : "";
}

/// The way down to a landing ends at the ground whatever it says.
void judge_ceiling(Look const& look, Findings& out) {
  double const highest_m = std::max(look.limits.highest_m, look.limits.ceiling_m);
  auto const is_over = [](double limit_m) {
    return [limit_m](Stop const& stop) {
      return stop.up_m && *stop.up_m > limit_m && stop.command != MavCmd::do_set_home && !stop.lands();
    };
  };
  auto const count = static_cast<std::size_t>(std::ranges::count_if(look.stops, is_over(look.limits.ceiling_m)));
  if (count == 0) return;
  auto const high = std::ranges::find_if(look.stops, is_over(highest_m));
  bool const is_absurd = high != look.stops.end();
  auto const& first = is_absurd ? *high : *std::ranges::find_if(look.stops, is_over(look.limits.ceiling_m));
  out.push_back({.rule = Rule::ceiling,
                 .severity = is_absurd ? Severity::refuse : Severity::warn,
                 .item = first.item,
                 .what = fmt::format("{}{} is {:.0f} m above the ground of home; the ceiling is {:.0f} m",
                                     item_text(first.item), more_text(count - 1), *first.up_m, look.limits.ceiling_m),
                 .meant = high_meant(look, first)});
}

}  // namespace

void judge_height(Look const& look, Findings& out) {
  if (!look.flies) return;
  judge_home_height(look, out);
  judge_take_off_height(look, out);
  judge_below(look, out);
  // The ceiling is the field's: a script alone does not know where it will be flown, nor by whose leave.
  if (!look.is_alone) judge_ceiling(look, out);
}

}  // namespace lapwing::plan::plausibility::internal
