#include "autonomy/interface/heights.hpp"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace lapwing::autonomy {

std::optional<std::string> heights_fault(HoverHeights const& heights) {
  struct Named {
    std::string_view name;
    double value_m;
  };
  for (auto const& [name, value_m] :
       std::array<Named, 3>{{{"lowest", heights.min_m}, {"desired", heights.desired_m}, {"highest", heights.max_m}}}) {
    if (!std::isfinite(value_m)) return fmt::format("the {} hover height is no number", name);
    if (value_m < lowest_hover_m)
      return fmt::format("the {} hover height ({} m) is below {} m", name, value_m, lowest_hover_m);
    if (value_m > highest_hover_m)
      return fmt::format("the {} hover height ({} m) is above {} m", name, value_m, highest_hover_m);
  }
  if (heights.min_m >= heights.desired_m)
    return fmt::format("the lowest hover height ({} m) is not below the desired one ({} m)", heights.min_m,
                       heights.desired_m);
  if (heights.desired_m >= heights.max_m)
    return fmt::format("the desired hover height ({} m) is not below the highest ({} m)", heights.desired_m,
                       heights.max_m);
  return std::nullopt;
}

}  // namespace lapwing::autonomy
