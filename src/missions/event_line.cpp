#include "missions/event_line.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/text/json.hpp"
#include "missions/mission_task.hpp"
#include "tasks/event_json.hpp"

namespace lapwing::missions {
namespace {

using Json = nlohmann::ordered_json;

/// Without the rounding errors of radians: far finer than the 1e-7 degrees of MAVLink.
double degrees(double value) {
  return std::round(value * 1e10) / 1e10;
}

Json to_json(mavlink::MissionItem const& item) {
  auto const place = plan::position_of(item);
  return {{"seq", item.seq},
          {"command", item.command},
          {"frame", item.frame},
          {"p1", base::shortest(item.params[0])},
          {"p2", base::shortest(item.params[1])},
          {"p3", base::shortest(item.params[2])},
          {"p4", base::shortest(item.params[3])},
          {"x", degrees(place.lat_deg())},
          {"y", degrees(place.lon_deg())},
          {"z", place.alt_m}};
}

}  // namespace

std::string event_line(tasks::TaskEvent const& event, Carrier const& carrier) {
  auto json = tasks::to_json(event);
  auto const* const flown = dynamic_cast<MissionTask const*>(event.subject.get());
  if (flown && event.kind == tasks::TaskEvent::Kind::start) {
    auto& items = json["items"] = Json::array();
    for (auto const& item : plan::for_autopilot(flown->mission(), carrier.autopilot, carrier.home, carrier.family))
      items.push_back(to_json(item));
  }
  return base::to_plain_line(json);
}

}  // namespace lapwing::missions
