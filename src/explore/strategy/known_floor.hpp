#pragma once

#include <memory>
#include <vector>

#include "explore/strategy/nearest_frontier.hpp"
#include "explore/strategy/strategy.hpp"

namespace lapwing::explore {

/// The floor as it is, for who may know it.
struct TrueFloor {
  KnownMap map;
  DenseGrid<std::uint8_t> is_wanted;  ///< cells that count
  double range_m = 10.0;
};

/// A yardstick and no strategy of a robot: it knows the floor before it begins and drives a short tour from which the
/// laser sees everything (watchman route; greedy cover by places, a tour over them, then places left out or moved while
/// what is seen on the way suffices). What no explorer can know is what makes it shorter than all of them. One robot.
class KnownFloor : public Strategy {
 public:
  KnownFloor(TrueFloor floor, Place const& start);
  [[nodiscard]] std::vector<Order> decide(Situation const& situation) override;

  [[nodiscard]] double planned_m() const { return planned_m_; }

 private:
  std::vector<Cell> way_;  ///< from the start over all places
  std::size_t at_ = 0;
  double planned_m_ = 0.0;
  NearestFrontier rest_;  ///< for what the tour missed
};

}  // namespace lapwing::explore
