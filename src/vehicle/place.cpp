#include "vehicle/place.hpp"

#include <numbers>

namespace lapwing::vehicle {

std::optional<GlobePose> on_globe(Place const& place, geo::Site const& site) {
  if (auto const* pose = std::get_if<GlobePose>(&place)) return *pose;
  auto const& pose = std::get<SitePose>(place);
  if (pose.site != site.id()) return std::nullopt;
  // The frame turns from east to north, a compass from north to east.
  return GlobePose{site.place_of(pose.position), geo::wrap_two_pi(std::numbers::pi / 2 - pose.yaw_rad)};
}

}  // namespace lapwing::vehicle
