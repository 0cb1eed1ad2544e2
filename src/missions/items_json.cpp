#include "missions/items_json.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "missions/mission_task.hpp"

namespace lapwing::missions {
namespace {

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

std::string items_json(tasks::TaskEvent const& event, Carrier const& carrier) {
  auto const* const flown = dynamic_cast<MissionTask const*>(event.subject.get());
  if (!flown || event.kind != tasks::TaskEvent::Kind::start) return {};
  std::string items;
  for (auto const& item : plan::for_autopilot(flown->mission(), carrier.autopilot, carrier.home, carrier.family)) {
    items += (items.empty() ? "" : ",") + to_json(item);
  }
  return fmt::format(R"("items":[{}])", items);
}

}  // namespace lapwing::missions
