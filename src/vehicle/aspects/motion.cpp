#include "vehicle/aspects/motion.hpp"

namespace lapwing::vehicle {

std::optional<Place> Motion::place() const {
  bool const knows_site = site_pose.known() && (!position.known() || site_pose.heard >= position.heard);
  if (knows_site) return *site_pose.value;
  if (position.known()) return GlobePose{*position.value, heading_rad.value};
  return std::nullopt;
}

}  // namespace lapwing::vehicle
