#include "autonomy/words/lot_task.hpp"

#include <fmt/format.h>

namespace lapwing::autonomy {

namespace {

struct ToText {
  std::string operator()(ExploreStep const&) const { return "explore"; }
  std::string operator()(MoveStep const& step) const {
    return fmt::format("move to {:.6f}, {:.6f}", step.place.lat_deg(), step.place.lon_deg());
  }
  std::string operator()(WaitStep const& step) const { return fmt::format("wait {:.0f} s", step.seconds); }
  std::string operator()(ComeHomeStep const&) const { return "come home"; }
};

}  // namespace

std::string to_text(Step const& step) {
  return std::visit(ToText{}, step);
}

std::optional<std::string> LotTask::unsuited(tasks::VehicleInfo const& vehicle) const {
  if (vehicle.type == "UAV") return std::nullopt;
  return fmt::format("a {} does not fly over a car park", vehicle.type);
}

std::optional<geo::Wgs84> LotTask::reference_position() const {
  for (auto const& step : steps_)
    if (auto const* const move = std::get_if<MoveStep>(&step)) return move->place;
  return std::nullopt;
}

}  // namespace lapwing::autonomy
