#pragma once

#include <optional>
#include <string>

#include "base/time.hpp"
#include "plan/mission.hpp"
#include "plan/performance.hpp"

namespace lapwing::plan {

struct Estimate {
  double path_m = 0.0;  ///< the way with its height differences, and loiter circles
  base::Duration duration{};
  bool is_endless = false;  ///< an unlimited loiter or jump is reached; length and time are those up to there
};

/// How far and how long `mission` flies from `start` (its home, if nothing; else its first place), in still air. Speed
/// changes and jumps within the mission are followed. `heading_rad` is where the nose points at the start, which
/// matters to those that cannot turn on the spot.
[[nodiscard]] Estimate estimate(Mission const& mission, std::optional<geo::Wgs84> start = std::nullopt,
                                Performance const& performance = {}, double heading_rad = 0.0);

/// What became of an estimate.
struct Flown {
  Estimate estimate;
  double path_m = 0.0;
  base::Duration duration{};
};
/// "146 s and 684 m flown, 140 s (+4 %) and 690 m (-1 %) estimated"
[[nodiscard]] std::string to_text(Flown const& flown);

}  // namespace lapwing::plan
