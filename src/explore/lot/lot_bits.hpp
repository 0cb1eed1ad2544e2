#pragma once

#include <vector>

#include "explore/lot/lot_map.hpp"

namespace lapwing::explore {

/// How a look errs, by what a pixel measures on the ground: as the planner expects it.
struct LookErrors {
  double slot_error = 0.015;  ///< "taken" and "free" mixed up, from near
  double coarse_m = 0.08;     ///< a pixel that measures so much makes twice as many
  double cell_error = 0.08;   ///< parking and not, whatever the height
  [[nodiscard]] double slot_error_at(double sampling_m) const;
};

/// The ground that a camera shows well enough from above (0, 0), so far from its edges that slots are whole: a convex
/// outline, as the half-planes in which it lies.
class Reach {
 public:
  /// `ring`: convex; `edge_m`: what is left out along its border.
  Reach(geo::Ring<geo::SiteFrame> const& ring, double edge_m);
  [[nodiscard]] bool contains(geo::Vector<geo::SiteFrame> const& from_camera) const;
  [[nodiscard]] geo::Box<geo::SiteFrame> const& box() const { return box_; }
  /// Its extent along a direction.
  [[nodiscard]] double extent_m(double way_rad) const;

 private:
  struct Half {
    Eigen::Vector2d into;
    double least;
  };
  std::vector<Half> halves_;
  std::vector<Eigen::Vector2d> corners_;
  geo::Box<geo::SiteFrame> box_;
};

/// What looks from somewhere would tell of a car park that is not known yet: how many bits, by blocks of cells and by
/// slots. Taking a view makes all of it that it shows known.
class LotBits {
 public:
  /// `with_age`: what has grown old counts as not known.
  LotBits(LotMap const& lot, base::UtcTime now, bool with_age, double block_m, LookErrors const& errors);

  struct Viewpoint {
    geo::Point3<geo::SiteFrame> place;
    Reach const* reach;
    double slot_error;
  };
  [[nodiscard]] double from(Viewpoint const& viewpoint) const;
  void take(Viewpoint const& viewpoint);
  /// Of ground that was never seen, in bits a square metre.
  [[nodiscard]] static double fresh_a_m2(LotSettings const& settings, LookErrors const& errors, double slot_error);

 private:
  struct Block {
    double fresh_cells = 0.0;  ///< bits of cells that were never seen
    double fresh_slots = 0.0;  ///< how many slots there may be where nothing was seen
    double seen_cells = 0.0;   ///< bits of cells that were, to one who looks from elsewhere
    Look seen = {};            ///< the last that they were
    std::vector<std::size_t> slots;
  };
  struct Slot {
    map::SitePoint middle;
    double taken_chance = 0.5;
    double there_bits = 0.0;
    double there_chance = 1.0;
    KnownSlot const* known = nullptr;
  };
  template <class Each>
  void for_each_block(Viewpoint const& viewpoint, Each&& each) const;
  void count_cells(LotMap const& lot, base::UtcTime now, bool with_age);
  void count_slots(LotMap const& lot, base::UtcTime now, bool with_age);
  [[nodiscard]] double bits_of(Block const& block, Viewpoint const& viewpoint) const;

  base::UtcTime now_;
  Independence independence_;
  double block_m_;
  LookErrors errors_;
  map::SitePoint origin_;
  DenseGrid<Block> blocks_;
  std::vector<Slot> slots_;
};

}  // namespace lapwing::explore
