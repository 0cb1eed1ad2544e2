#include <algorithm>

#include <fmt/format.h>

#include "plan/plausibility/internal/look.hpp"

/// Inside: places and ways against the fence of the plan that is uploaded along.
namespace lapwing::plan::plausibility::internal {

void judge_fence(Look const& look, Findings& out) {
  auto const& fence = look.situation.fence;
  auto const anchor = look.situation.home ? look.situation.home : look.start;
  if (!fence || fence->zones.empty() || !anchor) return;
  auto const zones = level(*fence, *anchor);
  if (!zones) return;
  geo::LocalFrame const frame(*anchor);
  Track track;
  std::vector<std::size_t> items;
  double up_m = 0.0;
  auto const add = [&](geo::Wgs84 place, std::size_t item) {
    auto at = frame.ned_from({place.lat_rad, place.lon_rad, anchor->alt_m});
    at.down = -up_m;
    track.push_back({.time = std::chrono::seconds(track.size()), .place_m = at});
    items.push_back(item);
  };
  if (auto const& from = look.situation.position) {
    if (look.situation.on_ground == false && look.ground_m) up_m = from->alt_m - *look.ground_m;
    add(*from, 0);
  }
  for (auto const& stop : look.stops) {
    if (stop.is_here || stop.command == mavlink::MavCmd::do_set_home) continue;
    up_m = stop.lands() ? 0.0 : stop.up_m.value_or(up_m);
    add(stop.place, stop.item);
  }
  auto const found = track.empty() ? std::vector<Breach>() : breaches(track, *zones);
  if (found.empty()) return;
  auto const& worst = found.front();
  auto const point = std::min(static_cast<std::size_t>(base::to_seconds(worst.worst.time) + 0.999), items.size() - 1);
  out.push_back({.rule = Rule::outside_fence,
                 .item = items[point],
                 .what = fmt::format("{} or the way there is {} {} the fence ({})", look.text_of(items[point]),
                                     distance_text(worst.depth_m),
                                     worst.kind == Zone::Kind::inclusion ? "outside" : "inside what is shut out by",
                                     worst.by_height ? "by height" : worst.zone),
                 .meant = "the vehicle would break off and return"});
}

}  // namespace lapwing::plan::plausibility::internal
