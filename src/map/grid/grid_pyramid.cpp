#include "map/grid/grid_pyramid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::map {

namespace {

constexpr double lowest_taken = 127.0;  // as a shade, where taken begins

Shade computed_shade(Evidence evidence) {
  double const probability = evidence.probability();
  if (probability > 0.5) return static_cast<Shade>(std::lround(lowest_taken + 1.0 + (probability - 0.5) * 2.0 * 127.0));
  return static_cast<Shade>(std::lround(1.0 + (0.5 - probability) * 2.0 * 126.0));
}

/// Of every log-odds that there is: an exponential a cell would take ten times as long as all the rest.
class ShadeTable {
 public:
  ShadeTable() {
    for (int steps = -middle; steps <= middle; ++steps)
      shades_[index_of(steps)] = computed_shade(Evidence::of_steps(steps));
  }
  [[nodiscard]] Shade of(Evidence evidence) const {
    return evidence.is_seen() ? shades_[index_of(evidence.steps())] : Shade{0};
  }

 private:
  static constexpr int middle = Evidence::most_steps;
  static constexpr std::size_t index_of(int steps) {
    int const index = middle + steps;
    return static_cast<std::size_t>(index);
  }
  std::array<Shade, 2 * middle + 1> shades_ = {};
};

ShadeTable const& shade_table() {
  static ShadeTable const table;
  return table;
}

/// `from` has `side` a side, `into` half as much.
void halve(std::span<Shade const> from, std::span<Shade> into, std::size_t side) {
  for (std::size_t y = 0; y < side / 2; ++y) {
    auto const* lower = &from[2 * y * side];
    auto const* upper = lower + side;
    auto* row = &into[y * side / 2];
    for (std::size_t x = 0; x < side / 2; ++x)
      row[x] = std::max(std::max(lower[2 * x], lower[2 * x + 1]), std::max(upper[2 * x], upper[2 * x + 1]));
  }
}

}  // namespace

Shade shade_of(Evidence evidence) {
  return shade_table().of(evidence);
}

std::optional<double> probability_of(Shade shade) {
  if (shade == 0) return std::nullopt;
  if (shade > lowest_taken) return 0.5 + (shade - lowest_taken - 1.0) / (2.0 * 127.0);
  return 0.5 - (shade - 1.0) / (2.0 * 126.0);
}

TileShades shades_of(GridTile const& tile) {
  auto const& table = shade_table();
  TileShades shades;
  std::ranges::transform(tile.cells, shades.begin(), [&](Evidence cell) { return table.of(cell); });
  return shades;
}

GridPyramid::Tile::Tile(std::shared_ptr<GridTile const> source) : source_(std::move(source)) {
  fill(shades_of(*source_));
}

GridPyramid::Tile::Tile(TileShades const& shades) {
  fill(shades);
}

void GridPyramid::Tile::fill(TileShades const& shades) {
  std::ranges::copy(shades, shades_.begin());
  for (int i = 0; i + 1 < levels; ++i)
    halve(level(i), std::span(shades_).subspan(begin_of(i + 1)), static_cast<std::size_t>(tile_cells >> i));
}

GridPyramid::GridPyramid(OccupancyGrid const& grid)
    : resolution_m_(grid.resolution_m()), site_from_grid_(grid.site_from_grid()), extent_(grid.extent()) {
  for (auto const& [key, tile] : grid.tiles()) tiles_.emplace_hint(tiles_.end(), key, std::make_shared<Tile>(tile));
}

GridPyramid::GridPyramid(OccupancyGrid const& grid, GridPyramid const& before)
    : resolution_m_(grid.resolution_m()), site_from_grid_(grid.site_from_grid()), extent_(grid.extent()) {
  for (auto const& [key, tile] : grid.tiles()) {
    auto const known = before.tiles_.find(key);
    bool const is_same = known != before.tiles_.end() && known->second->source() == tile;
    tiles_.emplace_hint(tiles_.end(), key, is_same ? known->second : std::make_shared<Tile const>(tile));
  }
}

GridPyramid::GridPyramid(double resolution_m, geo::Transform<geo::SiteFrame, GridFrame> const& site_from_grid,
                         Tiles tiles)
    : resolution_m_(resolution_m), site_from_grid_(site_from_grid), tiles_(std::move(tiles)) {
  // The extent is that of a grid with the same tiles.
  OccupancyGrid outline(resolution_m, site_from_grid);
  auto const nothing = std::make_shared<GridTile>();
  for (auto const& [key, tile] : tiles_) outline.set_tile(key, nothing);
  extent_ = outline.extent();
}

GridPyramid::Tile const* GridPyramid::tile(TileKey key) const {
  auto const found = tiles_.find(key);
  return found == tiles_.end() ? nullptr : found->second.get();
}

}  // namespace lapwing::map
