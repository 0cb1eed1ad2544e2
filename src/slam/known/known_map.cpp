#include "slam/known/known_map.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::slam {
namespace {

constexpr double taken = 0.65;
constexpr float least_cell_m = 0.05F;  // finer distances than a laser's noise help nobody
constexpr double most_cells = 1e8;

std::vector<Eigen::Vector2f> walls_of(map::OccupancyGrid const& grid) {
  std::vector<Eigen::Vector2f> walls;
  for (auto const& [key, tile] : grid.tiles()) {
    for (std::int32_t i = 0; i < map::tile_cells * map::tile_cells; ++i) {
      if (tile->cells[static_cast<std::size_t>(i)].probability() <= taken) continue;
      map::Cell const cell{key.x * map::tile_cells + i % map::tile_cells,
                           key.y * map::tile_cells + i / map::tile_cells};
      walls.push_back((grid.site_from_grid() * grid.centre_of(cell)).v.cast<float>());
    }
  }
  return walls;
}

}  // namespace

base::Result<KnownMap> KnownMap::make(map::OccupancyGrid const& grid) {
  auto const walls = walls_of(grid);
  if (walls.empty()) return base::fail(base::ErrorKind::invalid_input, "no cell of the map is taken");
  auto const cell_m = std::max(least_cell_m, static_cast<float>(grid.resolution_m()));
  Eigen::Vector2f low = walls.front();
  Eigen::Vector2f high = low;
  for (auto const& wall : walls) {
    low = low.cwiseMin(wall);
    high = high.cwiseMax(wall);
  }
  Eigen::Vector2d const side = (high - low).cast<double>().array() + 4.0 * far_m;
  if (side.x() * side.y() / (least_cell_m * least_cell_m) > most_cells)
    return base::fail(base::ErrorKind::invalid_input, "the map is larger than a hundred million cells of 5 cm");
  return KnownMap(walls, cell_m);
}

KnownMap::KnownMap(std::vector<Eigen::Vector2f> const& walls, float cell_m) : pyramid_(walls), cell_m_(cell_m) {
  Eigen::Vector2f low = walls.front();
  Eigen::Vector2f high = low;
  for (auto const& wall : walls) {
    low = low.cwiseMin(wall);
    high = high.cwiseMax(wall);
  }
  middle_ = 0.5 * (low + high).cast<double>();
  half_side_m_ = 0.5 * static_cast<double>((high - low).maxCoeff());
  auto const reach = static_cast<int>(std::ceil(far_m / cell_m_));
  // The middle of a cell of the map is the middle of one here, where the map is not turned.
  origin_ = low.cast<double>().array() - (static_cast<double>(reach) + 0.5) * static_cast<double>(cell_m_);
  width_ = static_cast<int>(std::lround((high.x() - low.x()) / cell_m_)) + 2 * reach + 2;
  height_ = static_cast<int>(std::lround((high.y() - low.y()) / cell_m_)) + 2 * reach + 2;
  distances_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), far_m);
  for (auto const& wall : walls) {
    Eigen::Vector2d const cell = (wall.cast<double>() - origin_) / static_cast<double>(cell_m_);
    auto const x = static_cast<int>(cell.x());
    auto const y = static_cast<int>(cell.y());
    for (int j = std::max(0, y - reach); j <= std::min(height_ - 1, y + reach); ++j) {
      for (int i = std::max(0, x - reach); i <= std::min(width_ - 1, x + reach); ++i) {
        auto const apart = cell_m_ * std::sqrt(static_cast<float>((i - x) * (i - x) + (j - y) * (j - y)));
        auto& distance =
            distances_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)];
        distance = std::min(distance, apart);
      }
    }
  }
}

KnownMap::Distance KnownMap::distance(Eigen::Vector2d const& place) const {
  Eigen::Vector2d const at_cells = (place - origin_) / static_cast<double>(cell_m_) - Eigen::Vector2d::Constant(0.5);
  if (!(at_cells.minCoeff() > -1.0 && at_cells.x() < width_ && at_cells.y() < height_)) return {};
  auto const x = static_cast<int>(std::floor(at_cells.x()));
  auto const y = static_cast<int>(std::floor(at_cells.y()));
  auto const u = static_cast<float>(at_cells.x() - x);
  auto const v = static_cast<float>(at_cells.y() - y);
  auto const a = at(x, y);
  auto const b = at(x + 1, y);
  auto const c = at(x, y + 1);
  auto const d = at(x + 1, y + 1);
  return {.m = (1.0F - v) * ((1.0F - u) * a + u * b) + v * ((1.0F - u) * c + u * d),
          .slope = {((1.0F - v) * (b - a) + v * (d - c)) / cell_m_, ((1.0F - u) * (c - a) + u * (d - b)) / cell_m_}};
}

}  // namespace lapwing::slam
