#pragma once

#include <optional>
#include <vector>

#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"

namespace lapwing::explore {

/// A piece of the border between what is known to be free and what is unknown, short enough to be looked at from one
/// place, and where to stand for it. Or a piece of wall that may have been a person.
struct Frontier {
  std::vector<std::uint32_t> cells;
  Cell middle = {};        ///< the cell of it nearest to the middle of all
  Cell stand = {};         ///< the standable cell that is the fewest steps over free cells away from there
  RoadMap::Node node = 0;  ///< of `stand`
  bool is_shut = false;    ///< there is no way to it any more: `stand` is where a robot was turned away
};

struct FrontierSettings {
  double least_m = 0.3;  ///< shorter ones are gaps between beams
  double most_m = 2.5;   ///< longer ones are divided
  double stand_within_m = 12.0;
  int most_looks = 3;           ///< at what remains, where things move; else one
  int most_put_off = 12;        ///< times that there was no way
  double again_after_s = 10.0;  ///< it is tried again, and after each time by so much later,
  double most_again_s = 30.0;   ///< but no later than this
  double turned_away_m = 3.0;   ///< from where it was to stand for it: nearer than that a robot saw what shut it out
  int most_shut = 4;            ///< times that it is tried again from there
  double bars_view_m = 2.5;     ///< whoever is nearer to a frontier than this may have stood before it
  double looked_at_m = 0.6;     ///< of a frontier, around its middle, when it is given up
  double least_person_m = 0.2;
  double person_m = 1.5;  ///< a piece of wall that is longer was none
};

/// The frontiers of a map, without those that were looked at from where one can stand and remained.
///
/// When nothing else is open, those are tried again to which there was no way; and where things were seen to move, also
/// those that remained, and walls that were seen at one moment only: somebody may have stood there. Those to which the
/// map has no way any more, since a door was shut before a robot, are tried again from where it was turned away.
class Frontiers {
 public:
  explicit Frontiers(KnownMap const& map, FrontierSettings const& settings = {});

  /// When all that is asked from now on happens, and where the robots are then.
  void set_moment(double time_s, std::vector<Place> robots = {}) {
    time_s_ = time_s;
    robots_ = std::move(robots);
  }

  /// Those to which there is a way in `reach`, in order of their cells.
  [[nodiscard]] std::vector<Frontier> find(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach);
  /// All that are open and were not given up, also those to which there is no way; without where to stand.
  [[nodiscard]] std::vector<Frontier> find_all(KnownMap const& map);
  /// It has not been seen yet what is there.
  [[nodiscard]] static bool is_open(KnownMap const& map, Frontier const& frontier) {
    return map.is_frontier(frontier.middle) || map.is_doubtful(frontier.middle);
  }
  /// It was looked at from where one can stand, and remained. Its ends are still open: the place was chosen for its
  /// middle. Where another robot may have stood before it, and where things move, it is looked at again later.
  void give_up(KnownMap const& map, Frontier const& frontier);
  /// There was no way to it. It is tried again, but not at once: whoever stands in the way needs time to leave.
  void put_off(KnownMap const& map, Frontier const& frontier);
  /// Something open is to be tried again later: nothing is explored before that.
  [[nodiscard]] bool is_any_put_off(KnownMap const& map) const;

 private:
  struct Mark {
    std::uint8_t is_left = 0;  ///< alone, for now
    std::uint8_t looks = 0;
    std::uint8_t put_off = 0;
    std::uint8_t shut = 0;  ///< times that it was looked for from where a robot was turned away
    float again_s = 0.0F;   ///< not tried before
  };
  struct PutOff {
    Cell middle = {};
    double again_s = 0.0;
    std::optional<Cell> from = {};  ///< where a robot was turned away
  };

  [[nodiscard]] float again_s(int times) const;
  void note_put_off(Cell middle, std::optional<Cell> from);
  [[nodiscard]] std::optional<Cell> turned_away_at(KnownMap const& map, Frontier const& frontier) const;
  [[nodiscard]] bool take_up_again(KnownMap const& map);
  [[nodiscard]] std::vector<Frontier> find_open(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach);
  [[nodiscard]] std::vector<Frontier> find_shut(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach);
  [[nodiscard]] std::vector<Frontier> find_doubtful(KnownMap const& map, RoadMap const& roads,
                                                    RoadMap::Tree const& reach);
  template <class Belongs>
  [[nodiscard]] Frontier grow(KnownMap const& map, Cell from, std::size_t most_cells, Belongs const& belongs);
  [[nodiscard]] bool find_stand(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach,
                                Frontier& frontier);

  FrontierSettings settings_;
  DenseGrid<Mark> marks_;
  DenseGrid<std::uint32_t> seen_by_;  ///< the number of the search
  std::uint32_t searches_ = 0;
  std::vector<PutOff> put_off_;  ///< the last time of each
  std::vector<Place> robots_;
  double time_s_ = 0.0;
};

}  // namespace lapwing::explore
