#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>

#include "map/grid/occupancy_grid.hpp"

namespace lapwing::map {

/// One cell as a byte, such that of several the greatest is the one to show where there is room for one only: 0 for
/// what was never seen, 1 to 127 for free, the surer the greater, 128 to 255 for taken, likewise. So a wall stays to be
/// seen from however far away.
using Shade = std::uint8_t;

[[nodiscard]] Shade shade_of(Evidence evidence);
/// One tile of a grid as it is drawn, row by row from the lowest.
using TileShades = std::array<Shade, std::size_t{tile_cells} * tile_cells>;
[[nodiscard]] TileShades shades_of(GridTile const& tile);
/// That it is taken, to 0.4 percent; nothing for what was never seen.
[[nodiscard]] std::optional<double> probability_of(Shade shade);

/// An occupancy grid made ready to be drawn at any size: each tile as shades, and halved again and again until it is
/// one. A value; a copy costs a pointer a tile, and it may go to other threads.
class GridPyramid {
 public:
  static constexpr int levels = 9;  ///< 256, 128, ... 1 a side

  /// Of an empty grid.
  GridPyramid() : GridPyramid(OccupancyGrid(1.0)) {}
  explicit GridPyramid(OccupancyGrid const& grid);
  /// What has not changed since `before` is taken from there.
  GridPyramid(OccupancyGrid const& grid, GridPyramid const& before);

  class Tile;
  using Tiles = std::map<TileKey, std::shared_ptr<Tile const>>;
  /// Of tiles that are known as shades alone.
  GridPyramid(double resolution_m, geo::Transform<geo::SiteFrame, GridFrame> const& site_from_grid, Tiles tiles);

  [[nodiscard]] double resolution_m() const { return resolution_m_; }
  [[nodiscard]] geo::Transform<geo::SiteFrame, GridFrame> const& site_from_grid() const { return site_from_grid_; }
  [[nodiscard]] std::optional<geo::Box<GridFrame>> const& extent() const { return extent_; }

  /// Null: nothing is known there.
  [[nodiscard]] Tile const* tile(TileKey key) const;

 private:
  double resolution_m_;
  geo::Transform<geo::SiteFrame, GridFrame> site_from_grid_;
  std::optional<geo::Box<GridFrame>> extent_;
  Tiles tiles_;
};

/// The shades of one tile of a grid.
class GridPyramid::Tile {
 public:
  explicit Tile(std::shared_ptr<GridTile const> source);
  explicit Tile(TileShades const& shades);

  /// 256 >> level a side, row by row from the lowest.
  [[nodiscard]] std::span<Shade const> level(int level) const {
    return std::span(shades_).subspan(begin_of(level), begin_of(level + 1) - begin_of(level));
  }
  /// Kept, so that nobody writes to it: as long as a grid has this one still, it has not changed. Null: made of shades.
  [[nodiscard]] std::shared_ptr<GridTile const> const& source() const { return source_; }

 private:
  /// In how many shades the levels before it are written.
  static constexpr std::size_t begin_of(int level) {
    constexpr std::size_t cells = std::size_t{tile_cells} * tile_cells;
    return (4 * cells - ((4 * cells) >> (2 * level))) / 3;
  }
  void fill(TileShades const& shades);

  std::shared_ptr<GridTile const> source_;
  std::array<Shade, (4 * std::size_t{tile_cells} * tile_cells - 1) / 3> shades_;
};

}  // namespace lapwing::map
