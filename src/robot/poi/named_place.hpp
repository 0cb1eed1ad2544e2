#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "map/features/contents.hpp"

namespace lapwing::robot {

/// Of all that lies on a floor: the place that somebody means who says `name`. What is called exactly so comes before
/// what has the words on its label, in any order and case: 'room 223', '223' and 'meeting room' are all words for a
/// door with the sign "223 meeting room". Signs of one door are one place. Errors: not_found when nothing is called so,
/// and when several places are: then it says which.
[[nodiscard]] base::Result<map::SitePoint> place_called(std::string_view name,
                                                        std::span<map::PointOfInterest const* const> points);

}  // namespace lapwing::robot
