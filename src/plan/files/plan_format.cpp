// What each format can hold of a plan.
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "plan/files/internal/plan_reader.hpp"
#include "plan/files/vehicle_plan.hpp"

namespace lapwing::plan {

using mavlink::MavCmd;
using mavlink::MavFrame;
using mavlink::MissionItem;

namespace {

using Lost = std::vector<std::string>;
/// Why an item cannot be held; nothing if it can.
using Objection = std::function<std::optional<std::string>(MissionItem const&)>;

/// No file of ours holds these.
std::optional<std::string> objection_of_files(MissionItem const& item) {
  if (!mavlink::is_listed(item.command)) return "is not known here, so neither is what its parameters are";
  if (internal::is_placed(item) && !mavlink::is_global(item.frame))
    return fmt::format("has its place in frame {}, which is not on Earth", static_cast<int>(item.frame));
  auto const place = position_of(item);
  if (internal::is_placed(item) && !internal::to_place(internal::file_degrees(place.lat_deg()),
                                                       internal::file_degrees(place.lon_deg()), place.alt_m))
    return "has no place and height on Earth";
  if (std::ranges::any_of(item.params, [](float value) { return std::isinf(value); }))
    return "has an infinite parameter";
  return std::nullopt;
}

std::optional<std::string> objection_of_kml(MissionItem const& item) {
  if (auto objection = objection_of_files(item)) return objection;
  if (!internal::is_placed(item)) return "has no place, and KML holds places";
  return std::nullopt;
}

/// Deprecated twins of frames.
MavFrame plain(MavFrame frame) {
  switch (frame) {
    case MavFrame::global_int: return MavFrame::global;
    case MavFrame::global_relative_alt_int: return MavFrame::global_relative_alt;
    case MavFrame::global_terrain_alt_int: return MavFrame::global_terrain_alt;
    default: return frame;
  }
}

/// Marks what a jump to it would lose with it, until nothing more is lost.
std::vector<bool> find_kept(std::vector<MissionItem> const& items, Objection const& objection, Lost& lost) {
  std::vector<bool> is_kept(items.size(), true);
  auto const drop = [&](std::size_t i, std::string_view why) {
    is_kept[i] = false;
    lost.push_back(fmt::format("item {}: {} {}", i + 1, to_string(items[i].command), why));
  };
  for (std::size_t i = 0; i < items.size(); ++i)
    if (auto const why = objection(items[i])) drop(i, *why);
  for (bool again = true; std::exchange(again, false);) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (!is_kept[i] || items[i].command != MavCmd::do_jump) continue;
      auto const target = static_cast<double>(items[i].params[0]);
      bool const is_there = target >= 1.0 && target <= static_cast<double>(items.size());
      if (is_there && is_kept[static_cast<std::size_t>(target) - 1]) continue;
      drop(i, fmt::format("leads to item {}, which is not there", target));
      again = true;
    }
  }
  return is_kept;
}

void keep_patterns(Plan& plan, std::vector<bool> const& is_kept, std::vector<std::size_t> const& new_index,
                   Lost& lost) {
  std::vector<Pattern> kept;
  for (auto& pattern : plan.patterns) {
    auto const begin = is_kept.begin() + static_cast<std::ptrdiff_t>(pattern.first);
    if (std::find(begin, begin + static_cast<std::ptrdiff_t>(pattern.count), false) !=
        begin + static_cast<std::ptrdiff_t>(pattern.count)) {
      lost.push_back(fmt::format("the pattern that begins at item {}: a part of it is lost", pattern.first + 1));
      continue;
    }
    pattern.first = new_index[pattern.first];
    kept.push_back(std::move(pattern));
  }
  plan.patterns = std::move(kept);
}

/// Drops the items that cannot be held; what is left keeps its order, jumps find their targets.
void keep_items(Plan& plan, Objection const& objection, Lost& lost) {
  auto& items = plan.mission.items;
  auto const is_kept = find_kept(items, objection, lost);
  std::vector<std::size_t> new_index;
  std::vector<MissionItem> kept;
  for (std::size_t i = 0; i < items.size(); ++i) {
    new_index.push_back(kept.size());
    if (is_kept[i]) kept.push_back(items[i]);
  }
  new_index.push_back(kept.size());
  for (auto& item : kept) {
    item.frame = plain(item.frame);
    if (item.command == MavCmd::do_jump)
      item.params[0] = static_cast<float>(new_index[static_cast<std::size_t>(item.params[0]) - 1] + 1);
  }
  keep_patterns(plan, is_kept, new_index, lost);
  items = std::move(kept);
}

void drop_patterns(Plan& plan, Lost& lost) {
  for (auto const& pattern : plan.patterns)
    lost.push_back(fmt::format("the pattern of items {} to {}, which becomes plain items", pattern.first + 1,
                               pattern.first + pattern.count));
  plan.patterns.clear();
}

void drop_settings(Plan& plan, Lost& lost) {
  if (plan.cruise_speed_m_s || plan.hover_speed_m_s) lost.emplace_back("cruise and hover speed");
  if (plan.firmware_type != 0 || plan.vehicle_type != 0) lost.emplace_back("what vehicle it was drawn for");
  plan.cruise_speed_m_s = plan.hover_speed_m_s = std::nullopt;
  plan.firmware_type = plan.vehicle_type = 0;
}

void keep_relative_rally_points(Plan& plan, Lost& lost) {
  std::vector<RallyPoint> kept;
  for (std::size_t i = 0; i < plan.rally.size(); ++i) {
    if (plan.rally[i].frame == MavFrame::global_relative_alt)
      kept.push_back(plan.rally[i]);
    else
      lost.push_back(fmt::format("rally point {}: its height is not above home", i + 1));
  }
  plan.rally = std::move(kept);
}

void reduce_to_qgc_plan(Plan& plan, Lost& lost) {
  plan.fence = simple_fence(plan.fence, lost);
  // Polygons and circles are two lists there.
  std::ranges::stable_partition(plan.fence.zones,
                                [](auto const& zone) { return !std::holds_alternative<GeoCircle>(zone.area); });
  keep_relative_rally_points(plan, lost);
}

/// One list a file: the mission, or what there is instead.
void reduce_to_way_points(Plan& plan, Lost& lost) {
  drop_patterns(plan, lost);
  drop_settings(plan, lost);
  bool const has_mission = !plan.mission.items.empty();
  bool const has_fence = !plan.fence.empty();
  if (has_mission && has_fence)
    lost.push_back(fmt::format("the fence of {} zones: a way point file holds one list", plan.fence.zones.size()));
  if ((has_mission || has_fence) && !plan.rally.empty())
    lost.push_back(fmt::format("{} rally points: a way point file holds one list", plan.rally.size()));
  if (has_mission || has_fence) plan.rally.clear();
  if (has_mission) {
    plan.fence = {};
    return;
  }
  if (plan.mission.planned_home && (has_fence || !plan.rally.empty())) {
    lost.emplace_back("the planned home: files of fences and rally points have none");
    plan.mission.planned_home.reset();
  }
  plan.fence = simple_fence(plan.fence, lost);
}

}  // namespace

Reduced reduce(Plan const& plan, PlanFormat format) {
  Reduced reduced{.plan = plan, .lost = {}};
  auto& [left, lost] = reduced;
  bool const is_kml = format == PlanFormat::kml || format == PlanFormat::kmz;
  if (left.mission.home) {
    lost.emplace_back("the home that a script has set");
    left.mission.home.reset();
  }
  keep_items(left, is_kml ? objection_of_kml : objection_of_files, lost);
  for (auto& point : left.rally) point.frame = plain(point.frame);
  switch (format) {
    case PlanFormat::qgc_plan: reduce_to_qgc_plan(left, lost); break;
    case PlanFormat::way_points: reduce_to_way_points(left, lost); break;
    case PlanFormat::kml:
    case PlanFormat::kmz:
      drop_patterns(left, lost);
      drop_settings(left, lost);
      break;
    case PlanFormat::geojson: break;
  }
  return reduced;
}

}  // namespace lapwing::plan
