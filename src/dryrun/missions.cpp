#include "dryrun/missions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "missions/mission_task.hpp"

namespace lapwing::dryrun {

using mavlink::MavCmd;
using mavlink::MissionItem;

namespace {

std::string note_of(MissionItem const& item) {
  auto const& p = item.params;
  switch (item.command) {
    case MavCmd::nav_loiter_turns: return fmt::format("{:g} turns", p[0]);
    case MavCmd::nav_loiter_time: return fmt::format("stays {:g} s", p[0]);
    case MavCmd::nav_loiter_unlim: return "stays";
    case MavCmd::nav_delay: return fmt::format("{:g} s", p[0]);
    case MavCmd::do_change_speed: return fmt::format("{:g} m/s", p[1]);
    case MavCmd::do_change_altitude: return fmt::format("to {:g} m", p[0]);
    case MavCmd::do_jump:
      return p[1] < 0.0F ? fmt::format("to item {:g} for ever", p[0])
                         : fmt::format("to item {:g}, {:g} times", p[0], p[1]);
    default: return {};
  }
}

std::vector<ItemRow> rows_of(plan::Mission const& mission, geo::Wgs84 home) {
  geo::LocalFrame const frame(home);
  std::vector<ItemRow> rows;
  double highest = 0.0;
  std::optional<geo::Wgs84> here = mission.home.value_or(home);
  for (auto const& item : mission.items) {
    ItemRow row{.number = static_cast<int>(rows.size()) + 1,
                .command = mavlink::to_string(item.command),
                .place_m = std::nullopt,
                .place = std::nullopt,
                .bar = {},
                .note = note_of(item)};
    if (plan::has_position(item)) {
      auto const place = plan::place_of(item, here, home.alt_m);
      row.place = here = place;
      row.place_m = frame.ned_from({place.lat_rad, place.lon_rad, home.alt_m});
      row.place_m->down = home.alt_m - place.alt_m;
      highest = std::max(highest, -row.place_m->down);
    }
    rows.push_back(std::move(row));
  }
  constexpr int width = 12;
  for (auto& row : rows) {
    if (!row.place_m) continue;
    auto const blocks = highest > 0.0 ? std::lround(width * std::max(0.0, -row.place_m->down) / highest) : 0;
    for (int i = 0; i < width; ++i) row.bar += i < blocks ? "▆" : "·";
  }
  return rows;
}

std::string allocation_of(std::string const& name, FlightRecord const& record) {
  std::string text;
  for (auto const& vehicle : record.vehicles) {
    auto const times = std::ranges::count(vehicle.tasks, name, &TaskSpan::name);
    if (times == 0) continue;
    text += text.empty() ? "flown by " : " and ";
    text += vehicle.name;
    if (times > 1) text += fmt::format(" ({} times)", times);
  }
  return text;
}

}  // namespace

std::vector<MissionTable> missions_of(FlightRecord const& record) {
  std::vector<TaskSpan const*> spans;
  for (auto const& vehicle : record.vehicles)
    for (auto const& span : vehicle.tasks) spans.push_back(&span);
  std::ranges::stable_sort(spans, {}, &TaskSpan::begin);
  std::vector<MissionTable> tables;
  for (auto const* span : spans) {
    auto const* flown = dynamic_cast<missions::MissionTask const*>(span->task.get());
    if (!flown || std::ranges::count(tables, span->name, &MissionTable::name) > 0) continue;
    tables.push_back({.name = span->name,
                      .allocation = allocation_of(span->name, record),
                      .items = rows_of(flown->mission(), record.home),
                      .mission = &flown->mission()});
  }
  return tables;
}

}  // namespace lapwing::dryrun
