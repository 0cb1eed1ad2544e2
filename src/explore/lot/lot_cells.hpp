#pragma once

#include <vector>

#include "explore/floor/dense_grid.hpp"
#include "explore/lot/lot_settings.hpp"
#include "explore/lot/lot_sight.hpp"
#include "geo/polygon.hpp"

namespace lapwing::explore {

/// Where people park and where not, cell by cell: the logarithm of the odds, to which each look adds (Moravec & Elfes
/// 1985) and which fades towards what is so anyway.
class LotCells {
 public:
  /// Precondition: the area is sound.
  LotCells(geo::Polygon<geo::SiteFrame> area, LotSettings settings);

  struct CellState {
    float log_odds = 0.0F;  ///< beside what is so anyway, as of `at_s`
    float at_s = 0.0F;      ///< since the first look
    float from_x_m = 0.0F;  ///< from where it was looked at last
    float from_y_m = 0.0F;
    float from_up_m = 0.0F;
    bool is_wanted = false;  ///< in the area
    bool is_seen = false;
  };

  [[nodiscard]] DenseGrid<CellState> const& grid() const { return cells_; }
  /// Of cell (0, 0), in cells of the site's frame.
  [[nodiscard]] Cell corner() const { return corner_; }
  [[nodiscard]] map::SitePoint middle(Cell cell) const;
  /// That people park there.
  [[nodiscard]] double parking_chance(CellState const& cell, base::UtcTime now) const;
  /// How much a look would say that was not said, 0 to 1.
  [[nodiscard]] double novelty(CellState const& cell, Look const& look) const;
  /// Precondition: it was.
  [[nodiscard]] base::UtcTime seen_at(CellState const& cell) const;
  [[nodiscard]] std::size_t wanted() const { return wanted_; }
  /// Of those the cells that were seen.
  [[nodiscard]] std::size_t seen() const { return seen_; }

  /// `standing`: cars that do. The cells of which something was learned, in the grid's own numbers.
  std::vector<Cell> add(LotSight const& sight, geo::Polygon<geo::SiteFrame> const& footprint,
                        std::vector<Corners> const& standing);

 private:
  struct Window;
  void spread(Window const& window, Corners const& outline, double sigma_m, double surety,
              std::vector<float>& onto) const;
  [[nodiscard]] Window window_of(geo::Polygon<geo::SiteFrame> const& footprint) const;
  [[nodiscard]] float since_first(base::UtcTime at) const;
  bool learn(CellState& cell, double log_likelihood, Look const& look);

  geo::Polygon<geo::SiteFrame> area_;
  LotSettings settings_;
  Cell corner_;
  DenseGrid<CellState> cells_;
  std::optional<base::UtcTime> first_;
  std::size_t wanted_ = 0;
  std::size_t seen_ = 0;
};

}  // namespace lapwing::explore
