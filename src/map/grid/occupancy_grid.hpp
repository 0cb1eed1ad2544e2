#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/time.hpp"
#include "geo/polygon.hpp"
#include "geo/site.hpp"
#include "geo/transform.hpp"
#include "map/features/geometry.hpp"

namespace lapwing::map {

/// Frame of a grid: its cells lie along x and y, cell (0, 0) has its lower left corner in the origin.
struct GridFrame {};

/// One cell, by how many cells it lies to the right of the origin and above it.
struct Cell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend auto operator<=>(Cell const&, Cell const&) = default;
};

/// What is known of one cell: the logarithm of the odds that it is taken (natural, Moravec & Elfes 1985), in steps of
/// 1/256, and whether anything is known at all. An unseen cell and one that is as likely taken as free differ.
class Evidence {
 public:
  constexpr Evidence() = default;  ///< never seen
  /// Clamped to +-`most_log_odds`. Precondition: a number.
  [[nodiscard]] static Evidence of_log_odds(double log_odds);
  /// Precondition: in [0, 1].
  [[nodiscard]] static Evidence of_probability(double probability);

  [[nodiscard]] constexpr bool is_seen() const { return steps_ != unseen; }
  /// 0 for an unseen one.
  [[nodiscard]] double log_odds() const;
  /// That it is taken; 0.5 for an unseen one.
  [[nodiscard]] double probability() const;
  /// Independent evidence adds up.
  [[nodiscard]] Evidence and_also(Evidence other) const;

  friend constexpr bool operator==(Evidence, Evidence) = default;

  static constexpr double most_log_odds = 20.0;

  /// In steps of 1/256, from -`most_steps` to `most_steps`: what is kept and sent. Precondition: one of these; seen.
  [[nodiscard]] static constexpr Evidence of_steps(int steps) {
    Evidence evidence;
    evidence.steps_ = static_cast<std::int16_t>(steps);
    return evidence;
  }
  [[nodiscard]] constexpr int steps() const { return steps_; }
  static constexpr int most_steps = 5120;

 private:
  static constexpr std::int16_t unseen = INT16_MIN;
  std::int16_t steps_ = unseen;
};

inline constexpr std::int32_t tile_cells = 256;  ///< a side

/// A square of cells, row by row from the lowest.
struct GridTile {
  std::array<Evidence, std::size_t{tile_cells} * tile_cells> cells = {};
};

/// Which tile: cell (x, y) is in tile (floor(x / 256), floor(y / 256)).
struct TileKey {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend auto operator<=>(TileKey const&, TileKey const&) = default;
};

/// An occupancy grid without end, in tiles that exist where something was seen. A copy costs a pointer a tile and is a
/// snapshot: who writes to one of the two copies the tiles that they share first. Snapshots may go to other threads.
class OccupancyGrid {
 public:
  /// Precondition: `resolution_m` from 0.001 to 100.
  explicit OccupancyGrid(double resolution_m, geo::Transform<geo::SiteFrame, GridFrame> site_from_grid = {});

  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  [[nodiscard]] geo::Transform<geo::SiteFrame, GridFrame> const& site_from_grid() const { return site_from_grid_; }

  [[nodiscard]] Cell cell_at(geo::Point<GridFrame> const& point) const;
  [[nodiscard]] geo::Point<GridFrame> centre_of(Cell cell) const;

  [[nodiscard]] Evidence at(Cell cell) const;
  void set(Cell cell, Evidence evidence);
  void add(Cell cell, Evidence evidence) { set(cell, at(cell).and_also(evidence)); }

  using Tiles = std::map<TileKey, std::shared_ptr<GridTile const>>;
  [[nodiscard]] Tiles const& tiles() const { return tiles_; }
  /// Null: nothing is known there any more. Precondition: not made as a constant, as it may be written to once no
  /// other grid has it.
  void set_tile(TileKey key, std::shared_ptr<GridTile const> tile);
  /// To write many cells of a tile: made or copied where needed. Valid until the grid is copied or destroyed.
  [[nodiscard]] GridTile& tile_to_write(TileKey key);

  /// The tiles that have been seen, in whole tiles; nothing for an empty grid.
  [[nodiscard]] std::optional<geo::Box<GridFrame>> extent() const;

 private:
  double resolution_m_;
  geo::Transform<geo::SiteFrame, GridFrame> site_from_grid_;
  Tiles tiles_;
};

[[nodiscard]] constexpr TileKey tile_of(Cell cell) {
  // Arithmetic shifts round towards minus infinity, as tiles left of the origin need it.
  return {cell.x >> 8, cell.y >> 8};
}

}  // namespace lapwing::map
