#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"
#include "explore/lead/giving_way.hpp"

namespace lapwing::robot {

/// What one robot knows of those beside it, and who of them makes room for whom where they stand in each other's way.
///
/// One decides for all, so that no two make room for each other: of those who explore the one whose id comes first,
/// else the first of all. All others do as it has told them.
class Company {
 public:
  /// Somebody who is about something, on the planner's floor.
  struct Neighbour {
    std::string id = {};
    bool explores = false;
    explore::GivingWay::Member now = {};
    std::map<std::string, explore::Place> asks = {};  ///< whom it asks to make room, and where to go for that
  };

  /// All who are there now, but for the robot itself.
  void take(std::vector<Neighbour> neighbours);
  [[nodiscard]] bool is_empty() const { return neighbours_.empty(); }
  /// Who stands near would be taken for a thing that is in the way.
  [[nodiscard]] bool is_beside(explore::Place const& place) const;

  struct Decision {
    /// Where all who are asked to are to go to make room, the robot itself (`self`) among them.
    std::map<std::string, explore::Place> asks = {};
    bool is_own = true;  ///< it is the one who decides, and has to tell the others
  };
  [[nodiscard]] Decision decide(explore::KnownMap const& map, explore::RoadMap const& roads, Neighbour const& self,
                                double radius_m, double time_s);

 private:
  std::vector<Neighbour> neighbours_;  ///< in the order of their ids
  explore::GivingWay rule_;
  std::vector<std::string> ruled_;  ///< whom the rule knows, in its order
};

}  // namespace lapwing::robot
