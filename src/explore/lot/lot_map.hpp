#pragma once

#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "explore/lot/lot_cells.hpp"
#include "explore/lot/slots/slot_book.hpp"
#include "explore/lot/standing_cars.hpp"
#include "map/features/feature.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::explore {

/// Who writes, and where the car park lies on the map.
struct LotAddress {
  std::string site;
  std::string floor = {};
  std::string writer;  ///< the vehicle or process whose account it is
};

/// What is new of a car park, as the map's layers take it.
struct LotNews {
  std::vector<map::Feature> slots;  ///< each as it was when it was seen last: what grows old does so with the reader
  std::vector<std::string> gone;    ///< ids of slots that are none after all, to be removed
  std::vector<map::TileKey> tiles;  ///< of the grid, that changed
};

/// A car park as nav_msgs/OccupancyGrid has it: row by row from the lowest, -1 where nothing is known, else 0 to 100.
struct LotOccupancy {
  map::SitePoint origin;  ///< the lower left corner of the first cell
  double resolution_m = 0.0;
  int width = 0;
  int height = 0;
  std::vector<std::int8_t> cells;
};

/// The mapper: what pictures tell of a car park becomes one map of it, which knows where people park, which slots there
/// are and whether they are taken, how sure that is and how old.
///
/// Pictures may come in any order; those that tell the same from the same place count once. What is in no picture grows
/// old: slots soon (`Turnover`), the layout slowly.
class LotMap {
 public:
  /// `area`: what is to be mapped. Errors, invalid_input: no sound polygon; more cells than a map holds; a setting that
  /// makes no sense.
  [[nodiscard]] static base::Result<LotMap> make(geo::Polygon<geo::SiteFrame> area, LotSettings settings = {});

  /// A slot that the map has already, so that it keeps its id.
  void know(std::string id, Corners const& outline) { slots_.know(std::move(id), outline); }
  /// Whether any of the ground that it shows lies in the area.
  bool add(LotSight const& told);

  [[nodiscard]] geo::Polygon<geo::SiteFrame> const& area() const { return area_; }
  [[nodiscard]] LotSettings const& settings() const { return settings_; }
  [[nodiscard]] LotCells const& cells() const { return cells_; }
  [[nodiscard]] SlotBook const& slots() const { return slots_; }
  /// The share of the area that was seen well enough to tell.
  [[nodiscard]] double coverage() const;
  /// What is not known of the car park, in bits: one for each slot, and one for each slot's size of ground that may be
  /// one.
  [[nodiscard]] double unknown_bits(base::UtcTime now) const;
  /// Is it in the lot as far as that is known: in the area, and on or within `reach_m` of ground for parking that was
  /// seen. Everything within the area as long as no parking was seen at all.
  [[nodiscard]] bool is_in_lot(map::SitePoint const& place, base::UtcTime now, double reach_m = 10.0) const;

  /// Since this was asked last.
  [[nodiscard]] LotNews take_news(LotAddress const& address);
  /// The chance that people park there, as the map has grids; a copy is a snapshot.
  [[nodiscard]] map::OccupancyGrid const& parking_grid() const { return parking_; }
  /// How likely one cannot park there: 0 a free slot, 100 a taken one or no place for parking; -1 where it was not
  /// seen, or nothing is known of the slot.
  [[nodiscard]] LotOccupancy occupancy(base::UtcTime now) const;

 private:
  LotMap(geo::Polygon<geo::SiteFrame> area, LotSettings const& settings);
  [[nodiscard]] map::Feature feature_of(KnownSlot const& slot, LotAddress const& address) const;

  geo::Polygon<geo::SiteFrame> area_;
  LotSettings settings_;
  LotCells cells_;
  SlotBook slots_;
  StandingCars cars_;
  map::OccupancyGrid parking_;
  std::set<map::TileKey> tiles_;
};

/// What of the ground a camera shows well enough for the detectors: nearer than `farthest_m`, and no coarser than
/// `coarsest_m` a pixel. Empty when none is.
[[nodiscard]] geo::Polygon<geo::SiteFrame> well_seen_ground(geo::GroundView const& view, LotSettings const& settings);

/// The ground of a slot as it is used to count bits: 2.5 m by 5 m.
inline constexpr double slot_ground_m2 = 12.5;

}  // namespace lapwing::explore
