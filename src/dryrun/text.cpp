#include "dryrun/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "dryrun/missions.hpp"
#include "dryrun/words.hpp"

namespace lapwing::dryrun {

using base::Duration;

namespace {

using Out = std::back_insert_iterator<std::string>;

/// Tables longer than this end with how much there is beyond; --json has everything.
constexpr std::size_t most_rows = 40;
constexpr std::size_t most_pairs = 6;

std::string percent(double share) {
  return fmt::format("{:.1f} %", 100.0 * share);
}

/// Heights as a row of blocks, `columns` wide.
std::string sparkline(VehicleRecord const& vehicle, Duration begin, Duration end, int columns) {
  constexpr std::array<std::string_view, 8> blocks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  double const highest = plan::greatest_height_m(plan::part(vehicle.track, begin, end));
  std::string line;
  for (int column = 0; column < columns; ++column) {
    auto const time = begin + (end - begin) * (2 * column + 1) / (2 * columns);
    double const height = std::max(0.0, -plan::place_at(vehicle.track, time).down);
    auto const level = highest < 0.5 ? 0.0 : std::round(7.0 * height / highest);
    line += blocks[static_cast<std::size_t>(std::clamp(level, 0.0, 7.0))];
  }
  return line;
}

std::string ending_text(TaskSpan const& span) {
  std::string text(to_string(span.ending));
  if (span.ending == TaskSpan::End::running) text = "still running at the end";
  if (!span.reason.empty()) text += ": " + span.reason;
  if (span.flown && span.ending == TaskSpan::End::done) {
    text += fmt::format(
        ", flown in {}, estimated {} ({})", clock_text(span.flown->duration), clock_text(span.flown->estimate.duration),
        difference_text(base::to_seconds(span.flown->duration), base::to_seconds(span.flown->estimate.duration)));
  }
  return text;
}

void write_tasks(Out out, VehicleRecord const& vehicle) {
  if (vehicle.tasks.empty()) return;
  std::size_t width = 4;
  for (auto const& span : vehicle.tasks) width = std::max(width, std::min<std::size_t>(span.name.size(), 32));
  fmt::format_to(out, "  {:>8} {:>8} {:>8}  {:>9} {:>8} {:>8} {:>8}  {:<{}}  {}\n", "start", "end", "lasts", "path",
                 "highest", "battery", "energy", "task", width, "outcome");
  for (auto const& span : vehicle.tasks) {
    if (&span == vehicle.tasks.data() + most_rows) {
      fmt::format_to(out, "  {:>8} {} more\n", "...", vehicle.tasks.size() + vehicle.tasks_left_out - most_rows);
      break;
    }
    auto const sums = figures(vehicle, span.begin, span.end);
    fmt::format_to(out, "  {:>8} {:>8} {:>8}  {:>9} {:>8} {:>8} {:>8}  {:<{}}  {}\n", clock_text(span.begin),
                   clock_text(span.end), clock_text(span.end - span.begin), length_text(sums.path_m),
                   fmt::format("{:.0f} m", sums.highest_m), percent(-sums.battery_used),
                   fmt::format("{:.2f} Wh", sums.energy_wh), span.name, width, ending_text(span));
  }
}

void write_vehicle(Out out, FlightRecord const& record, VehicleRecord const& vehicle, Figures const& sums) {
  bool const flies = plan::flies(vehicle.family);
  fmt::format_to(out, "\n{}: {} of path, {} {}", vehicle.name, length_text(sums.path_m), clock_text(vehicle.under_way),
                 flies ? "in the air" : "in motion");
  if (flies) fmt::format_to(out, ", up to {:.0f} m", sums.highest_m);
  if (!vehicle.charge.empty()) {
    fmt::format_to(out, ", battery {:.0f} -> {:.0f} % ({:.2f} Wh)\n", 100.0F * vehicle.charge.front().remaining,
                   100.0F * vehicle.charge.back().remaining, sums.energy_wh);
  }
  write_tasks(out, vehicle);
  constexpr int columns = 64;
  if (flies && sums.highest_m >= 0.5) {
    fmt::format_to(out, "  {:>8} {}  0 to {:.0f} m above the ground, {} to {}\n", "height",
                   sparkline(vehicle, Duration::zero(), record.duration, columns), sums.highest_m,
                   clock_text(Duration::zero()), clock_text(record.duration));
  }
  if (vehicle.ends_in_the_air) {
    double const height = -vehicle.track.back().place_m.down;
    fmt::format_to(out, "  warning: still in the air at the end, at {:.0f} m in mode {}\n", height,
                   vehicle.modes.back().mode);
  }
}

void write_missions(Out out, FlightRecord const& record) {
  for (auto const& mission : missions_of(record)) {
    fmt::format_to(out, "\nmission '{}': {} items, {}\n", mission.name, mission.items.size(), mission.allocation);
    fmt::format_to(out, "  {:>4}  {:<22} {:>9} {:>9} {:>9}  {}\n", "item", "command", "north", "east", "altitude",
                   "height above home");
    for (auto const& item : mission.items) {
      if (&item == mission.items.data() + most_rows) {
        fmt::format_to(out, "  {:>4}  {} more\n", "...", mission.items.size() - most_rows);
        break;
      }
      fmt::format_to(out, "  {:>4}  {:<22}", item.number, item.command);
      if (!item.place_m) {
        fmt::format_to(out, " {}\n", item.note);
        continue;
      }
      fmt::format_to(out, " {:>7} m {:>7} m {:>7} m  {} {} m{}{}\n", number_text(item.place_m->north, 1),
                     number_text(item.place_m->east, 1), number_text(item.place->alt_m, 1), item.bar,
                     number_text(-item.place_m->down, 0), item.note.empty() ? "" : ", ", item.note);
    }
  }
}

void write_approaches(Out out, FlightRecord const& record, Analysis const& analysis) {
  if (record.vehicles.size() < 2) return;
  fmt::format_to(out,
                 "\nclosest approach between vehicles (from when one of them is {:.0f} m from its parking place)\n",
                 parking_m);
  if (analysis.pairs.empty()) fmt::format_to(out, "  no vehicle left its parking place\n");
  for (auto const& pair : analysis.pairs) {
    if (&pair == analysis.pairs.data() + most_pairs) {
      fmt::format_to(out, "  and {} more pairs that stay farther apart\n", analysis.pairs.size() - most_pairs);
      break;
    }
    auto const& approach = pair.approach;
    fmt::format_to(out, "  {:>9}  {} and {} at {}, {} level, {} and {} m high, {}\n", length_text(approach.distance_m),
                   record.vehicles[pair.first].name, record.vehicles[pair.second].name, clock_text(approach.time),
                   length_text(approach.level_m), number_text(-approach.first_m.down, 0),
                   number_text(-approach.second_m.down, 0), place_text(approach.first_m));
  }
}

void write_zones(Out out, plan::Fence const& fence) {
  for (auto const& zone : fence.zones) {
    if (&zone == fence.zones.data() + most_rows) {
      fmt::format_to(out, "  and {} more zones\n", fence.zones.size() - most_rows);
      return;
    }
    fmt::format_to(out, "  {} '{}'", zone.kind == plan::Zone::Kind::inclusion ? "inside" : "outside", zone.name);
    if (zone.lowest_m) fmt::format_to(out, ", from {} m", number_text(*zone.lowest_m, 1));
    if (zone.highest_m) fmt::format_to(out, ", up to {} m", number_text(*zone.highest_m, 1));
    fmt::format_to(out, "{}\n", zone.lowest_m || zone.highest_m ? " above home" : "");
  }
}

void write_breaches(Out out, FlightRecord const& record, Analysis const& analysis, plan::Fence const& fence) {
  if (fence.zones.empty()) return;
  auto const count = analysis.breaches.size();
  fmt::format_to(out, "\nfence: {}\n",
                 count == 0 ? "kept by all" : fmt::format("{} breach{}", count, count == 1 ? "" : "es"));
  write_zones(out, fence);
  std::size_t rows = 0;
  for (auto const& [vehicle, breach] : analysis.breaches) {
    if (++rows > most_rows) {
      fmt::format_to(out, "  and {} more\n", count - most_rows);
      return;
    }
    bool const leaves = breach.kind == plan::Zone::Kind::inclusion;
    fmt::format_to(out, "  breach: {} {} '{}' from {} to {}: {} {}{}, at {}, {}, {} m high\n",
                   record.vehicles[vehicle].name, leaves ? "leaves" : "enters", breach.zone, clock_text(breach.begin),
                   clock_text(breach.end), length_text(breach.depth_m), leaves ? "outside" : "inside",
                   breach.by_height ? " in height" : "", clock_text(breach.worst.time),
                   place_text(breach.worst.place_m), number_text(-breach.worst.place_m.down, 0));
  }
}

void write_head(Out out, FlightRecord const& record) {
  fmt::format_to(out, "{}: {} after {} of flight{}{}\n", record.script, record.outcome, clock_text(record.duration),
                 record.reason.empty() ? "" : ": ", record.reason);
  for (auto const& waiting : record.waiting_for) fmt::format_to(out, "  at the end: {}\n", waiting);
  fmt::format_to(out, "home {:.7f},{:.7f} at {:.1f} m, {}, seed {}\n", record.home.lat_deg(), record.home.lon_deg(),
                 record.home.alt_m, wind_text(record.wind_m_s, record.gust_m_s), record.seed);
  fmt::format_to(out, "terrain is not known: the ground is level at the altitude of home\n");
}

}  // namespace

std::string to_text(FlightRecord const& record, Analysis const& analysis, plan::Fence const& fence) {
  std::string text;
  auto out = std::back_inserter(text);
  write_head(out, record);
  for (std::size_t i = 0; i < record.vehicles.size(); ++i)
    write_vehicle(out, record, record.vehicles[i], analysis.vehicles[i]);
  write_missions(out, record);
  if (!record.remarks.empty()) fmt::format_to(out, "\nthe script says\n");
  for (auto const& remark : record.remarks) fmt::format_to(out, "  {:>8}  {}\n", clock_text(remark.time), remark.text);
  write_approaches(out, record, analysis);
  write_breaches(out, record, analysis, fence);
  return text;
}

}  // namespace lapwing::dryrun
