#include "tasks/event_json.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

namespace lapwing::tasks {

nlohmann::ordered_json to_json(TaskEvent const& event) {
  nlohmann::ordered_json json{{"t", std::round(base::to_seconds(event.time.time_since_epoch()) * 1e3) / 1e3},
                              {"event", to_string(event.kind)},
                              {"task", event.task}};
  if (event.vehicle) json["vehicle"] = event.vehicle->text;
  if (!event.detail.empty()) json["detail"] = event.detail;
  return json;
}

}  // namespace lapwing::tasks
