#include "station/messages/alarm_messages.hpp"

#include <utility>

#include "base/text/utc_text.hpp"
#include "station/messages/client_request.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

Json to_json(vehicle::Alarm const& alarm, base::TimePoint now) {
  Json json{{"number", alarm.number},
            {"kind", vehicle::to_string(alarm.kind)},
            {"severity", vehicle::to_string(alarm.severity)},
            {"vehicle", alarm.vehicle.text},
            {"text", alarm.words},
            {"raised", base::to_iso8601(alarm.raised)},
            {"age_s", rounded(base::to_seconds(now - alarm.since), 3)}};
  if (!alarm.acknowledged_by.empty()) json["acknowledged_by"] = alarm.acknowledged_by;
  return json;
}

}  // namespace

std::string alarms_message(vehicle::VehicleAlarms const* alarms, base::TimePoint now) {
  Json list = Json::array();
  auto const limits = alarms ? alarms->battery_limits() : vehicle::BatteryLimits{};
  if (alarms)
    for (auto const& alarm : alarms->alarms()) list.push_back(to_json(alarm, now));
  return dump({{"type", "alarms"},
               {"battery", {{"low", limits.low}, {"critical", limits.critical}}},
               {"alarms", std::move(list)}});
}

void add_alarm_routes(Router& router, vehicle::VehicleAlarms* alarms, base::Loop const& loop) {
  auto const all = [alarms, &loop] { return alarms_message(alarms, loop.now()); };
  router.add("GET", "/api/v1/alarms", [all](HttpRequest const&) { return HttpResponse{.body = all()}; });
  router.add("POST", "/api/v1/alarms/acknowledge", [alarms, all](HttpRequest const& request) {
    auto const body = parse_request_body("acknowledge_alarms", request.body);
    if (!body) return problem(body.error());
    auto const& asked = std::get<AcknowledgeAlarms>(*body);
    if (alarms) (void)alarms->acknowledge(asked.numbers, asked.by.empty() ? unnamed_client : asked.by);
    return HttpResponse{.body = all()};
  });
}

}  // namespace lapwing::station
