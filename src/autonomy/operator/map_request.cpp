#include "autonomy/operator/map_request.hpp"

#include <nlohmann/json.hpp>

#include "autonomy/operator/command_text.hpp"

namespace lapwing::autonomy {

std::optional<base::Result<MapRequest>> parse_map_request(std::string_view text) {
  if (text.size() > longest_command) return std::nullopt;
  auto const object = nlohmann::json::parse(text, nullptr, false);
  if (!object.is_object() || object.value("Type", nlohmann::json()) != "Map") return std::nullopt;
  auto const wanted = object.value("Send", nlohmann::json());
  if (wanted == "Changes") return MapRequest::as_changes;
  if (wanted == "Heartbeat") return MapRequest::in_heartbeats;
  return base::fail(base::ErrorKind::invalid_input, "a Map is asked for with Send, as Changes or as Heartbeat",
                    R"(send {"Type":"Map","Send":"Changes"}, for example)");
}

std::string_view map_request_text(MapRequest request) {
  return request == MapRequest::as_changes ? R"({"Type":"Map","Send":"Changes"})"
                                           : R"({"Type":"Map","Send":"Heartbeat"})";
}

}  // namespace lapwing::autonomy
