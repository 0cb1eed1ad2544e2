#include "sim/guidance/rally.hpp"

#include <cmath>
#include <limits>

namespace lapwing::sim {

namespace {
double level_distance_m(geo::Ned a, geo::Ned b) {
  return std::hypot(a.north - b.north, a.east - b.east);
}
}  // namespace

ReturnPlace return_place(FlightContext const& context) {
  auto const here = context.body.position_m;
  ReturnPlace nearest{.point = context.home};
  double least_m = std::numeric_limits<double>::infinity();
  for (auto const& item : context.rally) {
    auto const point = point_of(item, context.site, context.home, here);
    double const away_m = level_distance_m(here, point);
    if (away_m >= least_m) continue;
    least_m = away_m;
    nearest = {.point = point, .is_rally = true};
  }
  auto const& tuning = context.tuning;
  bool const too_far = tuning.rally_limit_m > 0.0 && least_m > tuning.rally_limit_m;
  bool const home_is_nearer = tuning.rally_includes_home && level_distance_m(here, context.home) < least_m;
  if (too_far || home_is_nearer) return {.point = context.home};
  return nearest;
}

}  // namespace lapwing::sim
