#pragma once

#include <vector>

#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"

namespace lapwing::explore {

/// A piece of the border between what is known to be free and what is unknown, short enough to be looked at from one
/// place, and where to stand for it.
struct Frontier {
  std::vector<std::uint32_t> cells;
  Cell middle = {};        ///< the cell of it nearest to the middle of all
  Cell stand = {};         ///< the standable cell that is the fewest steps over free cells away from there
  RoadMap::Node node = 0;  ///< of `stand`
};

struct FrontierSettings {
  double least_m = 0.3;  ///< shorter ones are gaps between beams
  double most_m = 2.5;   ///< longer ones are divided
  double stand_within_m = 12.0;
};

/// The frontiers of a map, without those that were looked at from where one can stand and remained.
class Frontiers {
 public:
  explicit Frontiers(KnownMap const& map, FrontierSettings const& settings = {});

  /// Those to which there is a way in `reach`, in order of their cells.
  [[nodiscard]] std::vector<Frontier> find(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach);
  void give_up(Frontier const& frontier);
  [[nodiscard]] bool is_given_up(std::size_t cell) const { return given_up_.at_index(cell) != 0; }
  /// All are open again.
  void forgive();

 private:
  [[nodiscard]] Frontier grow(KnownMap const& map, Cell from, std::size_t most_cells);
  [[nodiscard]] bool find_stand(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach,
                                Frontier& frontier);

  FrontierSettings settings_;
  DenseGrid<std::uint8_t> given_up_;
  DenseGrid<std::uint32_t> seen_by_;  ///< the number of the search
  std::uint32_t searches_ = 0;
};

}  // namespace lapwing::explore
