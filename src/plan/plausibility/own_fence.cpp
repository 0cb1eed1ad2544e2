#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "plan/plausibility/internal/look.hpp"

/// Places and ways against the fence that the vehicle keeps to by itself.
namespace lapwing::plan::plausibility::internal {

namespace {

using mavlink::MavCmd;

/// Of roundings: a place at the edge is not beyond it.
constexpr double touching_m = 0.05;
/// Nobody holds a place better than this: what is nearer to an edge is said even where the vehicle keeps no margin.
constexpr double least_margin_m = 0.5;

/// How people set the limits.
struct Names {
  std::string_view radius;
  std::string_view highest;
  std::string_view lowest;
};
constexpr Names ardupilot_names{"FENCE_RADIUS", "FENCE_ALT_MAX", "FENCE_ALT_MIN"};
constexpr Names px4_names{"GF_MAX_HOR_DIST", "GF_MAX_VER_DIST", ""};

/// One limit, for people.
struct Edge {
  std::string words;  ///< "300 m round home (FENCE_RADIUS)"
  std::string mend;   ///< "set FENCE_RADIUS on the vehicle"
};
Edge edge_of(std::string_view parameter, double limit_m, std::string_view from) {
  return {fmt::format("{:.0f} m {} ({})", limit_m, from, parameter), fmt::format("set {} on the vehicle", parameter)};
}

/// A stop, and what of the fence is watched there.
struct Watched {
  Stop const* stop = nullptr;
  bool is_on = true;
  bool has_floor = true;
};

/// Missions switch fences on and off, and a landing does with the floor.
std::vector<Watched> watched_stops(Look const& look) {
  std::vector<Watched> watched;
  Watched now;
  std::size_t read = 0;
  for (auto const& stop : look.stops) {
    for (; read <= stop.item; ++read) {
      auto const& item = look.mission.items[read];
      if (item.command == MavCmd::do_land_start) now.has_floor = false;
      if (item.command != MavCmd::do_fence_enable) continue;
      constexpr float floor_off = 2.0F;
      now.is_on = item.params[0] != 0.0F;
      now.has_floor = item.params[0] != floor_off;
    }
    now.stop = &stop;
    if (stop.command != MavCmd::do_set_home) watched.push_back(now);
  }
  return watched;
}

class OwnFence {
 public:
  OwnFence(Look const& look, Findings& out)
      : look_(look), fence_(*look.situation.own_fence), out_(out), stops_(watched_stops(look)) {}

  void judge() {
    if (!look_.home && is_round_home()) tell_unknown_home();
    auto const& names = look_.situation.autopilot == vehicle::Autopilot::px4 ? px4_names : ardupilot_names;
    if (look_.home && fence_.radius_m)
      judge_radius(*fence_.radius_m, edge_of(names.radius, *fence_.radius_m, "round home"));
    if (look_.home && look_.flies && fence_.highest_m)
      judge_highest(*fence_.highest_m, edge_of(names.highest, *fence_.highest_m, "above home"));
    if (look_.home && look_.flies && fence_.lowest_m)
      judge_lowest(*fence_.lowest_m, edge_of(names.lowest, *fence_.lowest_m, "above home"));
    judge_areas();
  }

 private:
  [[nodiscard]] bool is_round_home() const {
    return fence_.radius_m || (look_.flies && (fence_.highest_m || fence_.lowest_m));
  }

  void tell_unknown_home() {
    if (stops_.empty()) return;
    out_.push_back({.rule = Rule::outside_fence,
                    .severity = Severity::warn,
                    .what = fmt::format("{} has not told its home", look_.situation.vehicle),
                    .meant = "nobody knows whether this leaves its own fence, which is measured from there"});
  }

  /// By how much each stop is beyond an edge; less than nothing for what is inside.
  struct Beyond {
    std::size_t item = 0;
    double depth_m = 0.0;
  };

  [[nodiscard]] std::optional<double> above_home_m(Stop const& stop) const {
    if (!stop.up_m) return std::nullopt;
    return look_.ground_m ? *stop.up_m + *look_.ground_m - look_.home->alt_m : *stop.up_m;
  }

  void judge_radius(double radius_m, Edge const& edge) {
    std::vector<Beyond> found;
    for (auto const& [stop, is_on, has_floor] : stops_)
      if (is_on && !stop->is_here)
        found.push_back({stop->item, geo::surface_distance_m(*look_.home, stop->place) - radius_m});
    tell_worst(found, "outside", edge);
  }

  void judge_highest(double highest_m, Edge const& edge) {
    std::vector<Beyond> found;
    for (auto const& [stop, is_on, has_floor] : stops_) {
      auto const up_m = above_home_m(*stop);
      if (is_on && up_m && !stop->lands()) found.push_back({stop->item, *up_m - highest_m});
    }
    tell_worst(found, "above", edge);
  }

  void judge_lowest(double lowest_m, Edge const& edge) {
    std::vector<Beyond> found;
    for (auto const& [stop, is_on, has_floor] : stops_) {
      auto const up_m = above_home_m(*stop);
      bool const passes = stop->lands() || stop->takes_off();
      if (is_on && has_floor && up_m && !passes) found.push_back({stop->item, lowest_m - *up_m});
    }
    tell_worst(found, "below", edge);
  }

  void tell_worst(std::vector<Beyond> const& found, std::string_view beyond, Edge const& edge) {
    if (found.empty()) return;
    auto const worst = *std::ranges::max_element(found, {}, &Beyond::depth_m);
    auto const is_outside = [](Beyond const& each) { return each.depth_m > touching_m; };
    if (is_outside(worst)) {
      auto const others = static_cast<std::size_t>(std::ranges::count_if(found, is_outside)) - 1;
      breach(worst.item,
             fmt::format("{}{} is {} {} {}'s own fence: {}", look_.text_of(worst.item), more_text(others),
                         distance_text(worst.depth_m), beyond, look_.situation.vehicle, edge.words),
             edge.mend);
    } else {
      tell_margin(worst, edge.words);
    }
  }

  void tell_margin(Beyond const& nearest, std::string_view words) {
    if (nearest.depth_m < -std::max(fence_.margin_m, least_margin_m)) return;
    auto const keeps = fence_.margin_m > 0.0 ? fmt::format("it keeps {:.1f} m of margin", fence_.margin_m) : "";
    out_.push_back({.rule = Rule::outside_fence,
                    .severity = Severity::warn,
                    .item = nearest.item,
                    .what = fmt::format("{} is only {:.1f} m inside {}'s own fence: {}", look_.text_of(nearest.item),
                                        std::max(0.0, -nearest.depth_m), look_.situation.vehicle, words),
                    .meant = keeps});
  }

  void breach(std::size_t item, std::string what, std::string_view mend) {
    auto const then = fence_.only_tells ? "it would report a breach" : "it would break off there";
    out_.push_back({.rule = Rule::outside_fence,
                    .severity = fence_.only_tells ? Severity::warn : Severity::refuse,
                    .item = item,
                    .what = std::move(what),
                    .meant = fmt::format("{}: bring it inside, or {}", then, mend)});
  }

  // ---- stored areas

  void judge_areas() {
    std::vector<GeoZone> inclusions;
    for (std::size_t i = 0; i < fence_.areas.zones.size(); ++i) {
      auto zone = fence_.areas.zones[i];
      zone.name = fmt::format("stored area {}", i + 1);
      bool const is_shared = zone.kind == Zone::Kind::inclusion && fence_.one_inclusion_will_do;
      if (is_shared)
        inclusions.push_back(std::move(zone));
      else
        judge_group({std::move(zone)});
    }
    if (!inclusions.empty()) judge_group(std::move(inclusions));
  }

  /// Of inclusions of which one will do, or of one area.
  void judge_group(std::vector<GeoZone> zones) {
    auto const anchor = look_.home ? look_.home : look_.start;
    if (!anchor) return;
    bool const shuts_out = zones.front().kind == Zone::Kind::exclusion;
    auto const fence = level({.zones = std::move(zones)}, *anchor);
    if (!fence) {
      // It is hundreds of kilometres away, and everything is outside.
      if (!shuts_out && !stops_.empty())
        breach(stops_.front().stop->item, fmt::format("{}'s own {}", look_.situation.vehicle, fence.error().message),
               mend_areas);
      return;
    }
    geo::LocalFrame const frame(*anchor);
    auto const begin = begin_of_way(*fence, frame);
    std::optional<Breach> worst;
    std::size_t worst_item = 0;
    for (auto const& part : ways(frame, begin)) {
      for (auto const& found : breaches(part.track, *fence)) {
        if (worst && found.depth_m <= worst->depth_m) continue;
        worst = found;
        auto const point = static_cast<std::size_t>(base::to_seconds(found.worst.time) + 0.999);
        worst_item = part.items[std::min(point, part.items.size() - 1)];
      }
    }
    if (!worst) return judge_area_margin(*fence, frame);
    breach(worst_item,
           fmt::format("{} or the way there is {} {}: {}", look_.text_of(worst_item), distance_text(worst->depth_m),
                       shuts_out ? fmt::format("inside what {}'s own fence shuts out", look_.situation.vehicle)
                                 : fmt::format("outside {}'s own fence", look_.situation.vehicle),
                       worst->zone),
           mend_areas);
  }

  /// Where the vehicle is, unless it is outside: then the way back in is no breach. On the ground it would not arm.
  std::optional<geo::Ned> begin_of_way(Fence const& fence, geo::LocalFrame const& frame) {
    auto const& at = look_.situation.position;
    if (!at) return std::nullopt;
    auto const begin = on_the_plane(frame, *at);
    Track const stays{{.time = {}, .place_m = begin}, {.time = std::chrono::seconds(1), .place_m = begin}};
    auto const found = breaches(stays, fence);
    if (found.empty()) return begin;
    if (look_.situation.on_ground.value_or(false) && !stops_.empty() && stops_.front().is_on)
      out_.push_back(
          {.rule = Rule::outside_fence,
           .severity = fence_.only_tells ? Severity::warn : Severity::refuse,
           .what = fmt::format("{} stands {} {}: {}", look_.situation.vehicle, distance_text(found.front().depth_m),
                               found.front().kind == Zone::Kind::inclusion ? "outside its own fence"
                                                                           : "inside what its own fence shuts out",
                               found.front().zone),
           .meant = "the fence of another place? Upload the one of this place, or clear it"});
    return std::nullopt;
  }

  struct Way {
    Track track;
    std::vector<std::size_t> items;
  };

  /// The straight way from place to place, in parts where the fence is switched off between.
  [[nodiscard]] std::vector<Way> ways(geo::LocalFrame const& frame, std::optional<geo::Ned> begin) const {
    std::vector<Way> ways(1);
    auto const add = [&](geo::Ned at, std::size_t item) {
      auto& [track, items] = ways.back();
      track.push_back({.time = std::chrono::seconds(track.size()), .place_m = at});
      items.push_back(item);
    };
    if (begin) add(*begin, stops_.empty() ? 0 : stops_.front().stop->item);
    for (auto const& [stop, is_on, has_floor] : stops_) {
      if (!is_on) {
        if (!ways.back().track.empty()) ways.emplace_back();
      } else if (!stop->is_here) {
        auto const at = on_the_plane(frame, stop->place);
        if (ways.back().track.empty()) add(at, stop->item);
        add(at, stop->item);
      }
    }
    return ways;
  }

  void judge_area_margin(Fence const& fence, geo::LocalFrame const& frame) {
    if (fence.zones.size() > 1) return;  // the edge of one may well be in the middle of another
    for (auto const& zone : fence.zones) {
      std::vector<Beyond> found;
      for (auto const& [stop, is_on, has_floor] : stops_) {
        if (!is_on || stop->is_here) continue;
        auto const at = on_the_plane(frame, stop->place);
        for (auto const& polygon : zone.polygons)
          found.push_back({stop->item, -distance_to_edge_m(polygon, {at.north, at.east})});
      }
      if (!found.empty()) tell_margin(*std::ranges::max_element(found, {}, &Beyond::depth_m), zone.name);
    }
  }

  [[nodiscard]] static geo::Ned on_the_plane(geo::LocalFrame const& frame, geo::Wgs84 place) {
    place.alt_m = frame.anchor().alt_m;
    auto at = frame.ned_from(place);
    at.down = 0.0;
    return at;
  }

  static constexpr std::string_view mend_areas = "upload another fence";

  Look const& look_;
  VehicleFence const& fence_;
  Findings& out_;
  std::vector<Watched> stops_;
};

}  // namespace

void judge_own_fence(Look const& look, Findings& out) {
  if (look.situation.own_fence) OwnFence(look, out).judge();
}

}  // namespace lapwing::plan::plausibility::internal
