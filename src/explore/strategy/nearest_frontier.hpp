#pragma once

#include <optional>
#include <vector>

#include "explore/strategy/strategy.hpp"

namespace lapwing::explore {

/// The nearest frontier by its way (Yamauchi 1997), looked for anew every three seconds and at each arrival, as
/// explore_lite does with its `planner_frequency` of 0.33 Hz. Several robots choose in turn, each the nearest that
/// none before it has.
class NearestFrontier : public Strategy {
 public:
  [[nodiscard]] std::vector<Order> decide(Situation const& situation) override;

 private:
  double next_look_s_ = 0.0;
  std::vector<std::optional<Frontier>> chosen_;  ///< a robot
};

}  // namespace lapwing::explore
