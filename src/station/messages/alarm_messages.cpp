#include "station/messages/alarm_messages.hpp"

#include <utility>

#include "station/messages/control_messages.hpp"
#include "station/messages/json_parts.hpp"

namespace lapwing::station {

namespace {

Json to_json(vehicle::Alarm const& alarm, base::TimePoint now) {
  Json json{{"number", alarm.number},
            {"kind", vehicle::to_string(alarm.kind)},
            {"severity", vehicle::to_string(alarm.severity)},
            {"vehicle", alarm.vehicle.text},
            {"text", alarm.words},
            {"raised", internal::to_text(alarm.raised)},
            {"age_s", rounded(base::to_seconds(now - alarm.since), 3)}};
  if (!alarm.acknowledged_by.empty()) json["acknowledged_by"] = alarm.acknowledged_by;
  return json;
}

}  // namespace

base::Result<AcknowledgeAlarms> parse_acknowledge_alarms(std::string_view text) {
  constexpr std::size_t most = 10'000;
  auto const object = internal::parse_object(text);
  if (!object) return std::unexpected(object.error());
  auto by = internal::operator_member(*object);
  if (!by) return std::unexpected(by.error());
  auto const found = object->find("numbers");
  if (found == object->end() || !found->is_array() || found->empty() || found->size() > most)
    return internal::wrong("\"numbers\" must be a list of alarms' numbers.");
  AcknowledgeAlarms request{{}, *std::move(by)};
  for (auto const& number : *found) {
    if (!number.is_number_unsigned()) return internal::wrong("\"numbers\" must be a list of alarms' numbers.");
    request.numbers.push_back(number.get<std::uint64_t>());
  }
  return request;
}

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
    auto asked = parse_acknowledge_alarms(request.body);
    if (!asked) return problem(asked.error());
    auto by = asked->by.empty() ? vehicle::Commander(unnamed_client) : std::move(asked->by);
    if (alarms) (void)alarms->acknowledge(asked->numbers, std::move(by));
    return HttpResponse{.body = all()};
  });
}

}  // namespace lapwing::station
