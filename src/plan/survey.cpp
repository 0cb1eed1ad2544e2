#include "plan/survey.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "plan/mission.hpp"

namespace lapwing::plan {
namespace {

using base::ErrorKind;
using base::fail;

bool is_positive(double value) {
  return std::isfinite(value) && value > 0.0;
}

double legs(SurveyArea const& area) {
  double const rounding = 1e-9;  // 0.3 / 0.1 is 2.9999999999999996 or 3.0000000000000004
  return std::max(1.0, std::ceil(area.width_m / area.spacing_m - rounding)) + 1.0;
}

base::Result<> check(SurveyArea const& area) {
  if (!is_positive(area.length_m) || !is_positive(area.width_m)) {
    return fail(
        ErrorKind::invalid_input,
        fmt::format("a survey area needs a length and a width above 0, not {} m by {} m", area.length_m, area.width_m));
  }
  double constexpr largest_m = 1e6;
  if (std::max({area.length_m, area.width_m, area.overshoot_m}) > largest_m) {
    return fail(ErrorKind::invalid_input,
                fmt::format("a survey of {} m by {} m is larger than 1000 km", area.length_m, area.width_m));
  }
  if (!is_positive(area.spacing_m)) {
    return fail(ErrorKind::invalid_input,
                fmt::format("legs of a survey need a spacing above 0, not {} m", area.spacing_m));
  }
  if (!(area.overshoot_m >= 0.0) || !std::isfinite(area.overshoot_m)) {
    return fail(ErrorKind::invalid_input,
                fmt::format("the room to turn beyond a survey must be 0 or more, not {} m", area.overshoot_m));
  }
  if (2.0 * legs(area) + 1.0 > static_cast<double>(max_mission_items)) {
    return fail(ErrorKind::invalid_input,
                fmt::format("a survey {} m wide with legs {} m apart has more places than a mission can hold ({})",
                            area.width_m, area.spacing_m, max_mission_items),
                "widen the spacing, or survey parts of the area");
  }
  return {};
}

}  // namespace

int leg_count(SurveyArea const& area) {
  return static_cast<int>(legs(area));
}

base::Result<std::vector<geo::Wgs84>> survey_path(SurveyArea const& area) {
  if (auto checked = check(area); !checked) return std::unexpected(checked.error());
  using enum SurveyDirection;
  double const north = area.direction == north_east || area.direction == north_west ? 1.0 : -1.0;
  double const east = area.direction == north_east || area.direction == south_east ? 1.0 : -1.0;
  double const far_end_m = north * (area.length_m + area.overshoot_m);
  double const near_end_m = -north * area.overshoot_m;

  std::vector<geo::Wgs84> path{area.base};
  int const count = leg_count(area);
  for (int leg = 0; leg < count; ++leg) {
    double const end_m = leg % 2 == 0 ? far_end_m : near_end_m;
    auto const reach = [&](int line) {
      double const offset_m = std::min(line * area.spacing_m, area.width_m);
      path.push_back(geo::displaced(area.base, {.north = end_m, .east = east * offset_m}));
    };
    reach(leg);
    if (leg + 1 < count) reach(leg + 1);
  }
  path.push_back(area.base);
  return path;
}

}  // namespace lapwing::plan
