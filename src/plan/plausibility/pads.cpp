#include <fmt/format.h>

#include "plan/plausibility/internal/look.hpp"
#include "plan/plausibility/judge.hpp"

/// Pads: where vehicles stand and land, seen together.
namespace lapwing::plan::plausibility {

using mavlink::MavCmd;

std::vector<geo::Wgs84> landing_places(Mission const& mission, std::optional<geo::Wgs84> vehicle_home) {
  std::vector<geo::Wgs84> places;
  auto const home = mission.home ? mission.home : vehicle_home;
  for (auto const& item : mission.items) {
    if (item.command == MavCmd::nav_land || item.command == MavCmd::nav_vtol_land) {
      auto const place = position_of(item);
      if (place.lat_rad != 0.0 || place.lon_rad != 0.0) places.push_back(place);
    }
    if (item.command == MavCmd::nav_return_to_launch && home) places.push_back(*home);
  }
  return places;
}

namespace internal {

namespace {

struct Clash {
  Neighbour const* neighbour = nullptr;
  double distance_m = 0.0;
  bool stands = false;  ///< else it will land there
};

std::optional<Clash> clash(Look const& look, geo::Wgs84 place) {
  for (auto const& neighbour : look.situation.neighbours) {
    if (neighbour.stands) {
      double const distance_m = geo::surface_distance_m(place, *neighbour.stands);
      if (distance_m < look.limits.pad_m) return Clash{&neighbour, distance_m, true};
    }
    for (auto const& landing : neighbour.lands_at) {
      double const distance_m = geo::surface_distance_m(place, landing);
      if (distance_m < look.limits.pad_m) return Clash{&neighbour, distance_m, false};
    }
  }
  return std::nullopt;
}

}  // namespace

void judge_pads(Look const& look, Findings& out) {
  if (!look.flies) return;
  for (auto const& place : landing_places(look.mission, look.situation.home)) {
    auto const found = clash(look, place);
    if (!found) continue;
    out.push_back({.rule = Rule::shared_pad,
                   .severity = Severity::warn,
                   .what = fmt::format("{} would land {} from where {} {}", look.situation.vehicle,
                                       distance_text(found->distance_m), found->neighbour->name,
                                       found->stands ? "stands" : "lands"),
                   .meant = "give each a place of its own"});
    return;
  }
  auto const& home = look.mission.home;
  auto const& at = look.situation.position;
  if (!home || !at || geo::surface_distance_m(*home, *at) < look.limits.pad_m) return;
  auto const found = clash(look, *home);
  if (!found || !found->stands) return;
  out.push_back({.rule = Rule::shared_pad,
                 .severity = Severity::warn,
                 .what = fmt::format("the home for {} is where {} stands ({} away)", look.situation.vehicle,
                                     found->neighbour->name, distance_text(found->distance_m)),
                 .meant = "do the two have each other's pads?"});
}

}  // namespace internal

}  // namespace lapwing::plan::plausibility
