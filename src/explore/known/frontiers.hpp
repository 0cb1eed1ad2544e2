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
  /// It was looked at from where one can stand, and remained.
  void give_up(Frontier const& frontier) { mark(frontier, given_up); }
  /// There was no way to it: it is tried again when nothing else is left, twice at most.
  void put_off(Frontier const& frontier) { mark(frontier, was_put_off); }

 private:
  enum : std::uint8_t { given_up = 1, was_put_off = 2 };

  void mark(Frontier const& frontier, std::uint8_t as);
  [[nodiscard]] bool take_up_again();
  [[nodiscard]] std::vector<Frontier> find_open(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach);
  [[nodiscard]] Frontier grow(KnownMap const& map, Cell from, std::size_t most_cells);
  [[nodiscard]] bool find_stand(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach,
                                Frontier& frontier);

  FrontierSettings settings_;
  DenseGrid<std::uint8_t> left_;      ///< of cells: why they are left alone, 0 for open ones
  DenseGrid<std::uint32_t> seen_by_;  ///< the number of the search
  std::uint32_t searches_ = 0;
  int times_taken_up_ = 0;
};

}  // namespace lapwing::explore
