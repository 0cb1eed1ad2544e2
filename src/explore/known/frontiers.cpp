#include "explore/known/frontiers.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::explore {

namespace {

std::size_t cells_in(double length_m, KnownMap const& map) {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(length_m / map.cell_m())));
}

}  // namespace

Frontiers::Frontiers(KnownMap const& map, FrontierSettings const& settings)
    : settings_(settings), marks_(map.width(), map.height()), seen_by_(map.width(), map.height(), 0) {}

std::vector<Frontier> Frontiers::find(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach) {
  auto found = find_open(map, roads, reach);
  if (found.empty() && take_up_again(map)) found = find_open(map, roads, reach);
  if (found.empty()) found = find_shut(map, roads, reach);
  if (found.empty() && map.has_seen_movement()) found = find_doubtful(map, roads, reach);
  return found;
}

std::vector<Frontier> Frontiers::find_open(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach) {
  auto found = find_all(map);
  std::erase_if(found, [&](Frontier& frontier) { return !find_stand(map, roads, reach, frontier); });
  return found;
}

std::vector<Frontier> Frontiers::find_all(KnownMap const& map) {
  // Their own order is that in which they came and went; that of the cells is the same for the same map.
  std::vector<std::uint32_t> cells(map.frontier_cells().begin(), map.frontier_cells().end());
  std::ranges::sort(cells);
  auto const least = cells_in(settings_.least_m, map);
  auto const most = std::max(least, cells_in(settings_.most_m, map));
  auto const round = ++searches_;
  std::vector<Frontier> grown;
  for (auto const index : cells) {
    if (seen_by_.at_index(index) == round || marks_.at_index(index).is_left != 0) continue;
    auto frontier = grow(map, map.cell_of(index), most, [&](Cell cell) { return map.is_frontier(cell); });
    if (frontier.cells.size() >= least) grown.push_back(std::move(frontier));
  }
  return grown;
}

std::vector<Frontier> Frontiers::find_shut(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach) {
  auto const least = cells_in(settings_.least_m, map);
  auto const most = std::max(least, cells_in(settings_.most_m, map));
  ++searches_;
  std::vector<Frontier> found;
  for (auto const& piece : put_off_) {
    auto const& mark = marks_[piece.middle];
    bool const is_due = time_s_ >= piece.again_s && mark.shut < settings_.most_shut && mark.is_left == 0;
    if (!piece.from || !is_due || !map.is_frontier(piece.middle) || seen_by_[piece.middle] == searches_) continue;
    auto const node = roads.node_near(*piece.from);
    if (!node || !reach.reaches(*node)) continue;
    auto frontier = grow(map, piece.middle, most, [&](Cell cell) { return map.is_frontier(cell); });
    if (frontier.cells.size() < least) continue;
    frontier.stand = roads.place_of(*node);
    frontier.node = *node;
    frontier.is_shut = true;
    found.push_back(std::move(frontier));
  }
  return found;
}

std::vector<Frontier> Frontiers::find_doubtful(KnownMap const& map, RoadMap const& roads, RoadMap::Tree const& reach) {
  auto const least = cells_in(settings_.least_person_m, map);
  auto const most = cells_in(settings_.person_m, map);
  auto const round = ++searches_;
  std::vector<Frontier> grown;
  for (std::size_t index = 0; index < marks_.size(); ++index) {
    auto const cell = map.cell_of(index);
    if (seen_by_.at_index(index) == round || !map.is_doubtful(cell)) continue;
    if (marks_.at_index(index).looks != 0 || marks_.at_index(index).is_left != 0) continue;
    // One cell more than a person shows that it is none.
    auto piece = grow(map, cell, 2 * most, [&](Cell at) { return map.is_doubtful(at); });
    if (piece.cells.size() >= least && piece.cells.size() <= most) grown.push_back(std::move(piece));
  }
  std::erase_if(grown, [&](Frontier& piece) { return !find_stand(map, roads, reach, piece); });
  return grown;
}

template <class Belongs>
Frontier Frontiers::grow(KnownMap const& map, Cell from, std::size_t most_cells, Belongs const& belongs) {
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
      if (frontier.cells.size() >= most_cells || !map.contains(next) || !belongs(next)) continue;
      if (seen_by_[next] == round || marks_[next].is_left != 0) continue;
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

float Frontiers::again_s(int times) const {
  return static_cast<float>(time_s_ + std::min(settings_.most_again_s, settings_.again_after_s * times));
}

void Frontiers::note_put_off(Cell middle, std::optional<Cell> from) {
  std::erase_if(put_off_, [&](PutOff const& other) { return other.middle == middle; });
  put_off_.push_back({middle, static_cast<double>(marks_[middle].again_s), from});
}

std::optional<Cell> Frontiers::turned_away_at(KnownMap const& map, Frontier const& frontier) const {
  auto const stand = map.middle(frontier.stand);
  auto const nearest =
      std::ranges::min_element(robots_, {}, [&](Place const& robot) { return distance_m(robot, stand); });
  if (nearest == robots_.end() || distance_m(*nearest, stand) > settings_.turned_away_m) return std::nullopt;
  return map.cell_at(*nearest);
}

void Frontiers::give_up(KnownMap const& map, Frontier const& frontier) {
  auto const middle = map.middle(frontier.middle);
  auto const near = std::ranges::count_if(
      robots_, [&](Place const& robot) { return distance_m(robot, middle) < settings_.bars_view_m; });
  if (near > 1 || frontier.is_shut) {
    put_off(map, frontier);
    return;
  }
  for (auto const cell : frontier.cells) {
    if (length_of(map.cell_of(cell) - frontier.middle) * map.cell_m() > settings_.looked_at_m) continue;
    auto& mark = marks_.at_index(cell);
    mark.is_left = 1;
    ++mark.looks;
    mark.again_s = again_s(mark.looks);
  }
  if (map.has_seen_movement() && marks_[frontier.middle].looks < settings_.most_looks)
    note_put_off(frontier.middle, std::nullopt);
}

void Frontiers::put_off(KnownMap const& map, Frontier const& frontier) {
  for (auto const cell : frontier.cells) {
    auto& mark = marks_.at_index(cell);
    mark.is_left = 1;
    ++mark.put_off;
    if (frontier.is_shut) ++mark.shut;
    mark.again_s = again_s(mark.put_off);
  }
  if (marks_[frontier.middle].put_off < settings_.most_put_off)
    note_put_off(frontier.middle, turned_away_at(map, frontier));
}

bool Frontiers::is_any_put_off(KnownMap const& map) const {
  // Robots look for what is open every few seconds only.
  constexpr double look_within_s = 5.0;
  return std::ranges::any_of(put_off_, [&](PutOff const& piece) {
    return time_s_ < piece.again_s + look_within_s && (map.is_frontier(piece.middle) || map.is_doubtful(piece.middle));
  });
}

bool Frontiers::take_up_again(KnownMap const& map) {
  int const most_looks = map.has_seen_movement() ? settings_.most_looks : 1;
  bool has_some = false;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    auto& mark = marks_.at_index(i);
    if (mark.is_left == 0 || mark.looks >= most_looks || mark.put_off >= settings_.most_put_off) continue;
    if (time_s_ < static_cast<double>(mark.again_s)) continue;
    mark.is_left = 0;
    has_some = true;
  }
  return has_some;
}

}  // namespace lapwing::explore
