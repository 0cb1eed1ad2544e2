#pragma once

#include <optional>
#include <string>

namespace lapwing::autonomy {

/// How high it flies, above where it was armed.
struct HoverHeights {
  double min_m = 7.0;
  double desired_m = 10.0;
  double max_m = 20.0;
  friend bool operator==(HoverHeights const&, HoverHeights const&) = default;
};

/// Below it trees, lamps and people are in the way.
inline constexpr double lowest_hover_m = 7.0;
/// Up to which small drones may fly without asking: the open category of EU 2019/947, and nearly 14 CFR 107.51.
inline constexpr double highest_hover_m = 120.0;

/// Why one cannot fly by them ("the desired hover height (25 m) is above the highest (20 m)"); nothing for sound ones.
[[nodiscard]] std::optional<std::string> heights_fault(HoverHeights const& heights);

}  // namespace lapwing::autonomy
