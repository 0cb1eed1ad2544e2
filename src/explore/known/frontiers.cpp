#include "explore/known/frontiers.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::explore {

Frontiers::Frontiers(KnownMap const& map, FrontierSettings const& settings)
    : settings_(settings), left_(map.width(), map.height(), 0), seen_by_(map.width(), map.height(), 0) {}

std::vector<Frontier> Frontiers::find(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach) {
  auto found = find_open(map, roads, reach);
  return found.empty() && take_up_again() ? find_open(map, roads, reach) : found;
}

std::vector<Frontier> Frontiers::find_open(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach) {
  // Their own order is that in which they came and went; that of the cells is the same for the same map.
  std::vector<std::uint32_t> cells(map.frontier_cells().begin(), map.frontier_cells().end());
  std::ranges::sort(cells);
  auto const least = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(settings_.least_m / map.cell_m())));
  auto const most = std::max(least, static_cast<std::size_t>(std::lround(settings_.most_m / map.cell_m())));
  auto const round = ++searches_;
  std::vector<Frontier> grown;
  for (auto const index : cells) {
    if (seen_by_.at_index(index) == round || left_.at_index(index) != 0) continue;
    auto frontier = grow(map, map.cell_of(index), most);
    if (frontier.cells.size() >= least) grown.push_back(std::move(frontier));
  }
  std::vector<Frontier> found;
  for (auto& frontier : grown) {
    if (find_stand(map, roads, reach, frontier)) found.push_back(std::move(frontier));
  }
  return found;
}

Frontier Frontiers::grow(KnownMap const& map, Cell from, std::size_t most_cells) {
  auto const round = searches_;
  Frontier frontier;
  frontier.cells.push_back(static_cast<std::uint32_t>(map.index_of(from)));
  seen_by_[from] = round;
  double sum_x = 0.0;
  double sum_y = 0.0;
  for (std::size_t i = 0; i < frontier.cells.size(); ++i) {
    auto const cell = map.cell_of(frontier.cells[i]);
    sum_x += cell.x;
    sum_y += cell.y;
    for (auto const away : neighbours) {
      auto const next = cell + away;
      if (frontier.cells.size() >= most_cells || !map.is_frontier(next)) continue;
      if (seen_by_[next] == round || left_[next] != 0) continue;
      seen_by_[next] = round;
      frontier.cells.push_back(static_cast<std::uint32_t>(map.index_of(next)));
    }
  }
  auto const count = static_cast<double>(frontier.cells.size());
  frontier.middle = map.cell_of(std::ranges::min(frontier.cells, {}, [&](std::uint32_t index) {
    auto const cell = map.cell_of(index);
    return std::hypot(cell.x - sum_x / count, cell.y - sum_y / count);
  }));
  return frontier;
}

bool Frontiers::find_stand(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach, Frontier& frontier) {
  auto const round = ++searches_;
  std::vector<Cell> open = {frontier.middle};
  seen_by_[frontier.middle] = round;
  auto const most = static_cast<std::size_t>(settings_.stand_within_m / map.cell_m()) * 40;
  for (std::size_t i = 0; i < open.size() && i < most; ++i) {
    auto const cell = open[i];
    auto const node = roads.node_at(cell);
    if (node && reach.reaches(*node)) {
      frontier.stand = cell;
      frontier.node = *node;
      return true;
    }
    for (auto const away : neighbours) {
      auto const next = cell + away;
      if (map.at(next) != Knowledge::free || seen_by_[next] == round) continue;
      seen_by_[next] = round;
      open.push_back(next);
    }
  }
  return false;
}

void Frontiers::mark(Frontier const& frontier, std::uint8_t as) {
  for (auto const cell : frontier.cells) left_.at_index(cell) = as;
}

bool Frontiers::take_up_again() {
  constexpr int most_times = 2;
  if (times_taken_up_ == most_times) return false;
  ++times_taken_up_;
  bool has_some = false;
  for (std::size_t i = 0; i < left_.size(); ++i) {
    if (left_.at_index(i) != was_put_off) continue;
    left_.at_index(i) = 0;
    has_some = true;
  }
  return has_some;
}

}  // namespace lapwing::explore
