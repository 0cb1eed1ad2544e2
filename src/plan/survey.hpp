#pragma once

#include <vector>

#include "base/error.hpp"
#include "geo/position.hpp"

namespace lapwing::plan {

/// Where the area lies as seen from its base corner.
enum class SurveyDirection { north_east, north_west, south_east, south_west };

/// A rectangle that is flown in legs along the meridian, at the base's altitude.
struct SurveyArea {
  geo::Wgs84 base;
  double length_m = 0.0;    ///< north-south
  double width_m = 0.0;     ///< east-west
  double spacing_m = 50.0;  ///< between legs; the last gap is narrower where the width is no multiple of it
  SurveyDirection direction = SurveyDirection::north_west;
  double overshoot_m = 25.0;  ///< room to turn, beyond the area at both ends of every leg
};

/// Legs that it takes to leave no gap wider than the spacing: ceil(width / spacing) + 1.
[[nodiscard]] int leg_count(SurveyArea const& area);

/// The places to fly through: the base, both ends of each gap between legs, the far end of the last leg, and the base
/// again; 2 legs + 1 of them, all at the base's altitude (language spec, 5.6, REC-30). Errors: invalid_input when a
/// measure is not positive, or the legs are too many for a mission.
[[nodiscard]] base::Result<std::vector<geo::Wgs84>> survey_path(SurveyArea const& area);

}  // namespace lapwing::plan
