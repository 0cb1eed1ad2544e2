#include "robot/words/drive_task.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lapwing::robot {

namespace {

struct ToText {
  std::string operator()(ExploreStep const&) const { return "explore"; }
  std::string operator()(DriveToPlaceStep const& step) const {
    return fmt::format("drive to {:.6f}, {:.6f}", step.place.lat_deg(), step.place.lon_deg());
  }
  std::string operator()(DriveToNameStep const& step) const { return fmt::format("drive to {}", step.name); }
  std::string operator()(ReturnStep const&) const { return "return to the start"; }
  std::string operator()(PhotographStep const&) const { return "photograph"; }
  std::string operator()(WaitStep const& step) const { return fmt::format("wait {:.0f} s", step.seconds); }
};

}  // namespace

std::string to_text(Step const& step) {
  return std::visit(ToText{}, step);
}

std::optional<std::string> DriveTask::unsuited(tasks::VehicleInfo const& vehicle) const {
  if (vehicle.type != "UGV") return fmt::format("a {} does not drive on a floor", vehicle.type);
  auto const photographs = [](Step const& step) { return std::holds_alternative<PhotographStep>(step); };
  if (vehicle.payload.empty() || !std::ranges::any_of(steps_, photographs)) return std::nullopt;
  if (std::ranges::find(vehicle.payload, camera_payload) != vehicle.payload.end()) return std::nullopt;
  return fmt::format("no payload {}", camera_payload);
}

std::optional<geo::Wgs84> DriveTask::reference_position() const {
  for (auto const& step : steps_)
    if (auto const* const drive = std::get_if<DriveToPlaceStep>(&step)) return drive->place;
  return std::nullopt;
}

}  // namespace lapwing::robot
