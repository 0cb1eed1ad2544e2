#include "tasks/event_json.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "tasks/mission_task.hpp"

namespace lapwing::tasks {
namespace {

std::string quoted(std::string_view text) {
  std::string json = "\"";
  for (char const c : text) {
    if (c == '"' || c == '\\') {
      json += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      json += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      json += c;
    }
  }
  return json + '"';
}

template <class Number>
std::string number(Number value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "null";
}

/// Without the rounding errors of radians: far finer than the 1e-7 degrees of MAVLink.
std::string degrees(double value) {
  return number(std::round(value * 1e10) / 1e10);
}

std::string to_json(mavlink::MissionItem const& item) {
  auto const place = plan::position_of(item);
  return fmt::format(R"({{"seq":{},"command":{},"frame":{},"p1":{},"p2":{},"p3":{},"p4":{},"x":{},"y":{},"z":{}}})",
                     item.seq, std::to_underlying(item.command), std::to_underlying(item.frame), number(item.params[0]),
                     number(item.params[1]), number(item.params[2]), number(item.params[3]), degrees(place.lat_deg()),
                     degrees(place.lon_deg()), number(place.alt_m));
}

}  // namespace

std::string to_json_line(TaskEvent const& event, Carrier const& carrier) {
  double const t = std::round(base::to_seconds(event.time.time_since_epoch()) * 1e3) / 1e3;
  auto line = fmt::format(R"({{"t":{},"event":{},"task":{})", t, quoted(to_string(event.kind)), quoted(event.task));
  if (event.vehicle) line += fmt::format(R"(,"vehicle":{})", quoted(event.vehicle->text));
  if (!event.detail.empty()) line += fmt::format(R"(,"detail":{})", quoted(event.detail));
  auto const* const flown = dynamic_cast<MissionTask const*>(event.subject.get());
  if (flown && event.kind == TaskEvent::Kind::start) {
    std::string items;
    for (auto const& item : plan::for_autopilot(flown->mission(), carrier.autopilot, carrier.home, carrier.family)) {
      items += (items.empty() ? "" : ",") + to_json(item);
    }
    line += fmt::format(R"(,"items":[{}])", items);
  }
  return line + "}";
}

}  // namespace lapwing::tasks
