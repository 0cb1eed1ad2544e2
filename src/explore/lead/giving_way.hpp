#pragma once

#include <optional>
#include <span>
#include <vector>

#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"

namespace lapwing::explore {

/// Robots that stand before each other where there is no way around: one makes room for a while. Whoever has nowhere to
/// go does it, else the one with the higher number, else the other.
class GivingWay {
 public:
  struct Member {
    Place at;
    bool wants_on = false;  ///< has somewhere to go
    double stood_s = 0.0;
  };

  /// For each robot the cell to go to instead of where it wants, nothing for those that may go on.
  [[nodiscard]] std::vector<std::optional<Cell>> decide(KnownMap const& map, RoadMap const& roads,
                                                        std::span<Member const> members, double radius_m,
                                                        double time_s);

 private:
  struct Aside {
    Cell to = {};
    double until_s = 0.0;
  };
  [[nodiscard]] bool send_aside(KnownMap const& map, RoadMap const& roads, std::span<Member const> members,
                                std::size_t who, double radius_m, double time_s);

  std::vector<std::optional<Aside>> aside_;
};

}  // namespace lapwing::explore
