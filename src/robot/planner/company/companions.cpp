#include "robot/planner/company/companions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include <Eigen/Core>

namespace lapwing::robot {

void CompanionMaps::take(std::vector<Companion> companions) {
  for (auto& before : companions_) before.explores = false;
  for (auto& one : companions) {
    auto const same = std::ranges::find(companions_, one.id, &Companion::id);
    if (same == companions_.end())
      companions_.push_back(std::move(one));
    else
      *same = std::move(one);
  }
  std::ranges::sort(companions_, {}, &Companion::id);
  turns_.clear();
  for (auto const& one : companions_) turns_.emplace_back(one.origin.yaw);
}

void CompanionMaps::clear() {
  companions_.clear();
  turns_.clear();
  known_.clear();
}

std::vector<map::TileKey> CompanionMaps::take_changes() {
  std::set<map::TileKey> changed;
  for (auto const& companion : companions_) {
    auto& known = known_[companion.id];
    for (auto const& [key, tile] : companion.grid.tiles()) {
      auto const before = known.find(key);
      if (before != known.end() && before->second == tile) continue;
      for (auto const ours : under(companion, key)) changed.insert(ours);
    }
    known = companion.grid.tiles();
  }
  return {changed.begin(), changed.end()};
}

std::vector<map::TileKey> CompanionMaps::tiles() const {
  std::set<map::TileKey> all;
  for (auto const& companion : companions_)
    for (auto const& [key, tile] : companion.grid.tiles())
      for (auto const ours : under(companion, key)) all.insert(ours);
  return {all.begin(), all.end()};
}

/// All under the rectangle around the turned tile.
std::vector<map::TileKey> CompanionMaps::under(Companion const& companion, map::TileKey key) {
  double const tile_m = map::tile_cells * companion.grid.resolution_m();
  Eigen::Array2d low = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array2d high = -low;
  for (int const right : {0, 1}) {
    for (int const up : {0, 1}) {
      auto const at = companion.origin * slam::Pose2{(key.x + right) * tile_m, (key.y + up) * tile_m, 0.0};
      low = low.min(slam::place(at).array() / tile_m);
      high = high.max(slam::place(at).array() / tile_m);
    }
  }
  std::vector<map::TileKey> tiles;
  for (auto y = static_cast<std::int32_t>(std::floor(low.y())); y < high.y(); ++y)
    for (auto x = static_cast<std::int32_t>(std::floor(low.x())); x < high.x(); ++x) tiles.push_back({x, y});
  return tiles;
}

explore::Knowledge CompanionMaps::at(Place const& place) const {
  map::Evidence all;
  for (std::size_t i = 0; i < companions_.size(); ++i) {
    auto const& grid = companions_[i].grid;
    Eigen::Vector2d const there = turns_[i].back(place.v - slam::place(companions_[i].origin));
    auto const told = grid.at(grid.cell_at({there.x(), there.y()}));
    if (told.is_seen()) all = all.is_seen() ? all.and_also(told) : told;
  }
  return explore::knowledge_of(all);
}

}  // namespace lapwing::robot
