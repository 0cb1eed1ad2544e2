#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "map/features/feature.hpp"
#include "robot/platform/robot.hpp"

namespace lapwing::robot {

/// The points of interest that a robot has found, as messages of the seed: numbered anew whenever one changes, so that
/// who has heard up to a number is told what came after it, once and in order.
class ToldPoints {
 public:
  /// Those of the robot among `records`. What the seed cannot say (further than 5 km) is left out; one that is gone
  /// from the map is told to nobody who comes later.
  void update(Robot const& robot, std::vector<map::FeatureRecord const*> const& records);
  /// Number and message, in the order of numbers; at most `most`.
  [[nodiscard]] std::vector<std::pair<std::uint64_t, std::string>> after(std::uint64_t number, std::size_t most) const;

 private:
  struct Told {
    std::string message;
    std::uint64_t number = 0;
  };
  std::map<std::string, Told> points_;  ///< by the feature's id
  std::uint64_t last_number_ = 0;
};

}  // namespace lapwing::robot
