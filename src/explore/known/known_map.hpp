#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "explore/floor/dense_grid.hpp"

namespace lapwing::explore {

enum class Knowledge : std::uint8_t { unknown, free, wall };

/// Of what was read of a map that somebody else made.
[[nodiscard]] Knowledge knowledge_of(map::Evidence evidence);

/// What a laser saw at one moment: beam i looks `yaw_rad + i * 2 pi / ranges_m.size()`; the range setting itself where
/// nothing was hit.
struct Scan {
  Pose from;
  double range_m = 0.0;
  std::vector<float> ranges_m;
  double time_s = 0.0;  ///< when; never less than that of the scan before
};

/// Where the beams of a scan look, each one long, from that straight ahead counterclockwise.
[[nodiscard]] std::vector<Shift> beam_ways(double yaw_rad, std::size_t beams);

/// Something that moves and is not to be drawn: people and other robots.
struct Disc {
  Place middle;
  double radius_m = 0.0;
};

/// What the robots know of the floor, and what follows from it for driving and exploring, kept up with every change.
///
/// A cell is *standable* when it and all cells within the keep-off distance are known to be free: what was not seen
/// blocks as walls do, so that whoever stands on such cells alone touches nothing. Cells that a robot has driven over
/// are standable whatever the map shows around them: it has been there. It is a *frontier* when it is free and one of
/// its four neighbours is unknown (Yamauchi 1997).
class KnownMap {
 public:
  struct Distances {
    double keep_off_m = 0.23;  ///< of the robot's middle from what is not known to be free
    double wary_m = 0.5;       ///< nearer to walls than this, ways cost more
  };
  KnownMap(int width, int height, double cell_m, Distances distances);

  [[nodiscard]] int width() const { return state_.width(); }
  [[nodiscard]] int height() const { return state_.height(); }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] double keep_off_m() const { return keep_off_m_; }
  [[nodiscard]] bool contains(Cell cell) const { return state_.contains(cell); }
  [[nodiscard]] std::size_t index_of(Cell cell) const { return state_.index_of(cell); }
  [[nodiscard]] Cell cell_of(std::size_t index) const { return state_.cell_of(index); }
  [[nodiscard]] Cell cell_at(Place const& place) const { return cell_under(place, cell_m_); }
  [[nodiscard]] Place middle(Cell cell) const { return middle_of(cell, cell_m_); }

  [[nodiscard]] Knowledge at(Cell cell) const { return state_.or_else(cell, Knowledge::wall); }
  /// Something that is not known to be free is within the keep-off distance.
  [[nodiscard]] bool is_too_near(Cell cell) const { return blockers_.or_else(cell, 1) != 0; }
  [[nodiscard]] bool is_standable(Cell cell) const { return !is_too_near(cell) || is_driven(cell); }
  /// Standable for the one reason that a robot has driven there.
  [[nodiscard]] bool is_tight(Cell cell) const { return is_too_near(cell) && is_driven(cell); }
  /// A wall is within the wary distance.
  [[nodiscard]] bool is_near_wall(Cell cell) const { return walls_near_.or_else(cell, 1) != 0; }
  /// A disc there lies on cells that are known to be free.
  [[nodiscard]] bool has_room(Place const& middle, double radius_m) const;
  /// In no order that means anything.
  [[nodiscard]] std::span<std::uint32_t const> frontier_cells() const { return frontier_; }
  [[nodiscard]] bool is_frontier(Cell cell) const {
    return frontier_place_.contains(cell) && frontier_place_[cell] != 0;
  }
  /// How many cells became known for the first time.
  [[nodiscard]] std::uint64_t discovered() const { return discovered_; }
  /// Something was seen to stand where the floor had been free: people are about, or doors are moved.
  [[nodiscard]] bool has_seen_movement() const { return has_seen_movement_; }
  /// A wall that was seen at one moment only, where things move: it may have been a person.
  [[nodiscard]] bool is_doubtful(Cell cell) const {
    return has_seen_movement_ && at(cell) == Knowledge::wall && is_sure_[cell] == 0;
  }

  /// Draws what the scan says (inverse sensor model: free along each beam, taken at its end). Ends on `moving` are left
  /// out, and what is at the end of a beam in a cell that was seen free often has to be seen there often as well.
  void add(Scan const& scan, std::span<Disc const> moving);
  /// One cell, for sure.
  void learn(Cell cell, Knowledge knowledge);
  /// A robot has driven over it; to be taken back as often as it was said, when it turns out to have been elsewhere.
  void add_driven(Cell cell);
  void take_back_driven(Cell cell);

  /// The cells that became standable or ceased to be since this was last asked.
  [[nodiscard]] std::vector<std::uint32_t> take_changes() { return std::exchange(changed_, {}); }
  /// The cells whose knowledge changed since this was last asked; some more than once.
  [[nodiscard]] std::vector<std::uint32_t> take_fresh() { return std::exchange(fresh_, {}); }

 private:
  /// The cells at whose ends beams were stopped, once each, by what does not move.
  std::vector<std::uint32_t> mark_ends(Scan const& scan, std::span<Shift const> ways, std::span<Disc const> moving);
  [[nodiscard]] bool is_driven(Cell cell) const { return driven_.or_else(cell, 0) != 0; }
  void pass(std::size_t index);
  void hit(std::size_t index);
  void notice_movement(std::span<std::uint32_t const> ends);
  void become(std::size_t index, Knowledge knowledge);
  /// `step`: 1 where something new is in the way, -1 where it no longer is.
  void count_blocker(Cell cell, int step);
  void count_wall(Cell cell, int step);
  void look_for_frontier(Cell cell);

  double cell_m_;
  double keep_off_m_;
  DenseGrid<Knowledge> state_;
  DenseGrid<std::int8_t> odds_;  ///< in steps: -1 for a beam that passes, 3 for one that ends
  DenseGrid<std::uint16_t> blockers_;
  DenseGrid<std::uint16_t> walls_near_;
  DenseGrid<std::uint16_t> driven_;          ///< how often
  DenseGrid<std::uint32_t> hit_by_;          ///< the number of the scan
  DenseGrid<float> wall_since_s_;            ///< when a wall was first seen
  DenseGrid<std::uint8_t> is_sure_;          ///< of walls: seen at two moments apart
  DenseGrid<std::uint8_t> was_free_;         ///< seen free often, once
  DenseGrid<std::uint32_t> frontier_place_;  ///< in `frontier_`, from 1
  std::vector<std::uint32_t> frontier_;
  std::vector<Cell> keep_off_;
  std::vector<Cell> wary_;
  std::vector<std::uint32_t> changed_;
  std::vector<std::uint32_t> fresh_;
  std::uint64_t discovered_ = 0;
  bool has_seen_movement_ = false;
  double time_s_ = 0.0;
  std::uint32_t scans_ = 0;
};

}  // namespace lapwing::explore
