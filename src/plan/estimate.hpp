#pragma once

#include <optional>

#include "base/time.hpp"
#include "plan/mission.hpp"

namespace lapwing::plan {

struct Speeds {
  double cruise_m_s = 10.0;
  double climb_m_s = 2.5;
  double descent_m_s = 1.5;
};

struct Estimate {
  double path_m = 0.0;  ///< straight legs with their height differences, and loiter circles
  base::Duration duration{};
  bool is_endless = false;  ///< an unlimited loiter or jump is reached; length and time are those up to there
};

/// How far and how long `mission` flies from `start` (its home, if nothing; else its first place), without wind,
/// acceleration and turns. Speed changes and jumps within the mission are followed.
[[nodiscard]] Estimate estimate(Mission const& mission, std::optional<geo::Wgs84> start = std::nullopt,
                                Speeds speeds = {});

/// What became of an estimate.
struct Flown {
  Estimate estimate;
  double path_m = 0.0;
  base::Duration duration{};
};

}  // namespace lapwing::plan
