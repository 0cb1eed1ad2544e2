#include "sim/fence.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace lapwing::sim {

unsigned FenceWatch::update(View const& view) {
  if (!std::ranges::equal(view.plan, read_, same_item)) read(view.plan, view.site);
  if (!enabled(view.settings) || !view.position_ok) {
    breached_ = 0;
    return 0;
  }
  if (view.body.on_ground) was_above_floor_ = false;
  if (view.home.down - view.body.position_m.down > view.settings.lowest_m) was_above_floor_ = true;
  auto now = crossed(view.body.position_m, view.home, view.settings);
  if (!was_above_floor_) now &= ~static_cast<unsigned>(floor);
  auto const fresh = now & ~breached_;
  if (fresh != 0) {
    if (breached_ == 0) breached_at_ = view.now;
    ++count_;
  }
  breached_ = now;
  return fresh;
}

std::string FenceWatch::objection() const {
  if (breached_ == 0) return {};
  auto const* const name = (breached_ & areas) != 0    ? "Polygon"
                           : (breached_ & circle) != 0 ? "Circle"
                           : (breached_ & height) != 0 ? "Max Alt"
                                                       : "Min Alt";
  return fmt::format("Vehicle breaching {} fence", name);
}

void FenceWatch::read(MissionPlan const& plan, Site const& site) {
  read_ = plan;
  areas_ = fence_areas(plan, site);
}

bool FenceWatch::allows(geo::Ned point, geo::Ned home, FenceSettings const& settings) const {
  return !enabled(settings) || (crossed(point, home, settings) & ~static_cast<unsigned>(floor)) == 0;
}

unsigned FenceWatch::crossed(geo::Ned point, geo::Ned home, FenceSettings const& settings) const {
  double const up_m = home.down - point.down;
  double const off_m = std::hypot(point.north - home.north, point.east - home.east);
  unsigned found = 0;
  if (settings.highest_m > 0.0 && up_m >= settings.highest_m) found |= height;
  if (up_m <= settings.lowest_m) found |= floor;
  if (settings.radius_m > 0.0 && off_m >= settings.radius_m) found |= circle;
  if (!in_the_areas(point, settings.any_inclusion)) found |= areas;
  return found & settings.watched;
}

bool FenceWatch::in_the_areas(geo::Ned point, bool any_inclusion) const {
  int inclusions = 0;
  int inside = 0;
  for (auto const& area : areas_) {
    bool const holds = contains(area, point);
    if (!area.includes && holds) return false;
    inclusions += area.includes ? 1 : 0;
    inside += area.includes && holds ? 1 : 0;
  }
  return any_inclusion ? inclusions == 0 || inside > 0 : inside == inclusions;
}

}  // namespace lapwing::sim
