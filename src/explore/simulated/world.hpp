#pragma once

#include "base/error.hpp"
#include "explore/floor/dense_grid.hpp"
#include "explore/floor/floor_plan.hpp"
#include "explore/run/settings.hpp"

namespace lapwing::explore {

/// The true floor around one start, and what of it a robot can be asked to see.
///
/// Cells of the plan are fine; `cells_a_side` of them make one of the robots' map. `is_standable`: map cells in which a
/// robot's centre keeps its distance from everything, connected with the start. `is_wanted`: free map cells from which
/// a straight free line no longer than the laser's range leads to one of those. Coverage is the share of wanted cells
/// that the map shows as free.
class World {
 public:
  /// Errors, invalid_input: the start lies in a wall, outside, or where the robot has no room.
  [[nodiscard]] static base::Result<World> around(FloorPlan const& plan, Place const& start, Settings const& settings);

  [[nodiscard]] double fine_m() const { return fine_m_; }
  [[nodiscard]] double cell_m() const { return fine_m_ * cells_a_side_; }
  [[nodiscard]] int width() const { return is_standable_.width(); }
  [[nodiscard]] int height() const { return is_standable_.height(); }
  [[nodiscard]] DenseGrid<std::uint8_t> const& is_free() const { return is_free_; }
  [[nodiscard]] DenseGrid<std::uint8_t> const& is_standable() const { return is_standable_; }
  [[nodiscard]] DenseGrid<std::uint8_t> const& is_wanted() const { return is_wanted_; }
  [[nodiscard]] std::size_t wanted() const { return wanted_; }
  [[nodiscard]] geo::Transform<geo::SiteFrame, FloorFrame> const& site_from_floor() const { return site_from_floor_; }
  /// Of the plan's frame in this one.
  [[nodiscard]] Shift plan_from_world() const { return plan_from_world_; }

  /// The middle of a map cell is free.
  [[nodiscard]] bool is_free_at(Cell cell) const {
    return is_free_.or_else(cell_under(middle_of(cell, cell_m()), fine_m_), 0) != 0;
  }
  /// Metres from `from` to the first wall in direction `way`, which is one long; `range_m` where there is none within.
  [[nodiscard]] double distance_to_wall_m(Place const& from, Shift const& way, double range_m) const;
  /// A disc there touches no wall.
  [[nodiscard]] bool has_room(Place const& middle, double radius_m) const;

 private:
  double fine_m_ = 0.0;
  int cells_a_side_ = 1;
  DenseGrid<std::uint8_t> is_free_;
  DenseGrid<std::uint8_t> is_standable_;
  DenseGrid<std::uint8_t> is_wanted_;
  std::size_t wanted_ = 0;
  geo::Transform<geo::SiteFrame, FloorFrame> site_from_floor_;
  Shift plan_from_world_;
};

/// Where robots may be put on a plan: the middles of map cells with room for one, in the largest part of the floor that
/// does not reach the plan's edge (what does is the outdoors), or the largest of all where each does. In order from
/// the lowest row; empty where a robot fits nowhere.
[[nodiscard]] std::vector<Place> possible_starts(FloorPlan const& plan, Settings const& settings);

}  // namespace lapwing::explore
