#include "tasks/mission_task.hpp"

#include <algorithm>

namespace lapwing::tasks {

std::optional<std::string> MissionTask::unsuited(VehicleInfo const& vehicle) const {
  if (vehicle.payload.empty() || !plan::takes_photos(mission_)) return std::nullopt;
  if (std::ranges::find(vehicle.payload, "Camera") != vehicle.payload.end()) return std::nullopt;
  return "no payload Camera";
}

}  // namespace lapwing::tasks
