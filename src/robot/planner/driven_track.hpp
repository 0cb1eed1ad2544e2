#pragma once

#include <span>
#include <vector>

#include "explore/known/known_map.hpp"

namespace lapwing::robot {

/// Keeps a map told where the robot has driven, while loops move what is known of that, and where it can be led from
/// where it is: where that is too near to something, to wherever it gets clearly farther away from all of it. A scanner
/// that looks no way back, or sees nothing ahead, leaves what is unknown at the robot's very hull.
class DrivenTrack {
 public:
  /// All places from the start to where it is now, in the order in which it came by them.
  void lay(explore::KnownMap& map, std::span<explore::Place const> places);

 private:
  struct Leg {
    explore::Cell from = {};
    explore::Cell to = {};
    friend bool operator==(Leg const&, Leg const&) = default;
  };
  std::vector<Leg> laid_;
  std::vector<explore::Cell> leads_away_;
};

}  // namespace lapwing::robot
