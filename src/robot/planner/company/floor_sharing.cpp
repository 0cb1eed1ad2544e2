// What a planner makes of those who explore its floor as well.
#include <utility>

#include "robot/planner/floor_planner.hpp"

namespace lapwing::robot {

using explore::Cell;
using explore::Knowledge;
using explore::operator+;  // NOLINT(misc-unused-using-decls): it adds cells below.

namespace {

constexpr double find_sharers_every_s = 1.0;

}  // namespace

void FloorPlanner::share(std::vector<Companion> companions, map::OccupancyGrid const& grid) {
  std::erase_if(companions, [](Companion const& one) { return !one.explores; });
  auto const known = companions_.all().size();
  if (companions.empty() && known == 0) return;
  companions_.take(std::move(companions));
  // A strategy counts the robots: with one more, others are who they were not.
  if (auto const* const exploring = std::get_if<ExploreErrand>(&errand_);
      exploring && companions_.all().size() != known)
    strategy_ = explore::make_strategy(exploring->strategy).value();
  auto changed = companions_.take_changes();
  if (area_.grow(changed)) {
    begin_anew();
    learn_all(grid);
    changed = companions_.tiles();
  }
  learn_theirs(grid, changed);
  roads_->update(*known_, known_->take_changes());
}

void FloorPlanner::learn_theirs(map::OccupancyGrid const& own, std::vector<map::TileKey> const& tiles) {
  if (tiles.empty()) return;
  if (!theirs_) theirs_.emplace(area_.width(), area_.height(), Knowledge::unknown);
  for (auto const key : tiles) {
    if (!area_.contains(key)) continue;
    auto const lowest = area_.lowest_cell_of(key);
    auto const tile = own.tiles().find(key);
    std::size_t index = 0;
    for (int y = 0; y < map::tile_cells; ++y) {
      for (int x = 0; x < map::tile_cells; ++x, ++index) {
        if (tile != own.tiles().end() && tile->second->cells[index].is_seen()) continue;
        auto const cell = lowest + Cell{x, y};
        (*theirs_)[cell] = companions_.at(on_map(known_->middle(cell)));
        learn(cell, (*theirs_)[cell]);
      }
    }
  }
}

explore::Pose FloorPlanner::pose_of(Companion const& companion) const {
  auto const at = companion.origin * companion.pose;
  return {on_floor({at.x, at.y}), at.yaw};
}

/// Who explores behind a door that is shut to this one has frontiers of its own.
void FloorPlanner::find_sharers(explore::Pose const& pose, double time_s) {
  auto const& companions = companions_.all();
  if (shares_.size() == companions.size() && time_s < sharers_found_s_ + find_sharers_every_s) return;
  sharers_found_s_ = time_s;
  shares_.assign(companions.size(), false);
  auto const here = roads_->node_near(known_->cell_at(pose.position));
  if (companions.empty() || !here) return;
  auto const tree = roads_->from(*here);
  for (std::size_t i = 0; i < companions.size(); ++i) {
    auto const there = roads_->node_near(known_->cell_at(pose_of(companions[i]).position));
    shares_[i] = companions[i].explores && there && tree.reaches(*there);
  }
}

std::pair<std::vector<explore::RobotView>, std::size_t> FloorPlanner::views(explore::RobotView own) const {
  std::vector<explore::RobotView> all;
  std::size_t mine = 0;
  for (std::size_t i = 0; i < companions_.all().size(); ++i) {
    auto const& companion = companions_.all()[i];
    explore::RobotView view;
    view.pose = pose_of(companion);
    view.is_out = !shares_[i];
    all.push_back(std::move(view));
    mine += companion.id < options_.id ? 1 : 0;
  }
  all.insert(all.begin() + static_cast<std::ptrdiff_t>(mine), std::move(own));
  return {std::move(all), mine};
}

}  // namespace lapwing::robot
