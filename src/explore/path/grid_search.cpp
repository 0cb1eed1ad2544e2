#include "explore/path/grid_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::explore {

namespace {

constexpr float near_wall_factor = 1.5F;
constexpr float tight_factor = 4.0F;

float factor_of(KnownMap const& map, Cell cell) {
  if (map.is_tight(cell)) return tight_factor;
  return map.is_near_wall(cell) ? near_wall_factor : 1.0F;
}

float octile(Cell a, Cell b) {
  auto const x = static_cast<float>(std::abs(a.x - b.x));
  auto const y = static_cast<float>(std::abs(a.y - b.y));
  return std::max(x, y) + (std::numbers::sqrt2_v<float> - 1.0F) * std::min(x, y);
}

/// May one drive over this cell? Where the robot stands too near to something already, what it fits on will do.
bool is_open(KnownMap const& map, Cell cell, Cell came_from, GridSearch::Request const& request) {
  if (!map.is_standable(cell) && (!map.is_too_near(came_from) || !map.has_room(map.middle(cell), request.radius_m)))
    return false;
  if (request.closed == nullptr) return true;
  auto const place = map.middle(cell);
  return std::ranges::none_of(*request.closed,
                              [&](Disc const& disc) { return distance_m(disc.middle, place) < disc.radius_m; });
}

/// Cells from one to the other, as near to the straight line as cells are; without the first.
std::vector<Cell> straight(Cell from, Cell to) {
  auto const way = to - from;
  int const steps = std::max(std::abs(way.x), std::abs(way.y));
  std::vector<Cell> line;
  line.reserve(static_cast<std::size_t>(steps));
  for (int i = 1; i <= steps; ++i) {
    double const share = static_cast<double>(i) / steps;
    line.push_back(from +
                   Cell{static_cast<int>(std::lround(share * way.x)), static_cast<int>(std::lround(share * way.y))});
  }
  return line;
}

}  // namespace

GridSearch::GridSearch(KnownMap const& map) : marks_(map.width(), map.height()) {}

std::vector<Cell> GridSearch::path(KnownMap const& map, Request const& request) {
  if (!map.contains(request.from) || !map.contains(request.to)) return {};
  ++searches_;
  Queue open;
  auto const from = static_cast<std::uint32_t>(map.index_of(request.from));
  auto const to = static_cast<std::uint32_t>(map.index_of(request.to));
  marks_.at_index(from) = {searches_, 0.0F, 0, false};
  open.push({octile(request.from, request.to), from});
  std::size_t looked_at = 0;
  while (!open.empty() && open.top().index != to && looked_at < request.most_cells) {
    auto const index = open.top().index;
    open.pop();
    if (marks_.at_index(index).is_closed) continue;
    marks_.at_index(index).is_closed = true;
    ++looked_at;
    look_around(map, request, index, open);
  }
  if (open.empty() || open.top().index != to) return {};
  std::vector<Cell> path = {request.to};
  while (path.back() != request.from) path.push_back(path.back() - neighbours[marks_[path.back()].came_by]);
  std::ranges::reverse(path);
  return straightened(map, request, path);
}

bool GridSearch::is_as_cheap(KnownMap const& map, Request const& request, Cell from, std::span<Cell const> line) const {
  constexpr float rounding = 1e-3F;  // of sums in another order
  float const most = marks_[line.back()].so_far - marks_[from].so_far + rounding;
  float cost = 0.0F;
  auto before = from;
  for (auto const cell : line) {
    cost += octile(before, cell) * factor_of(map, cell);
    if (cost > most || !is_open(map, cell, before, request)) return false;
    before = cell;
  }
  return true;
}

std::vector<Cell> GridSearch::straightened(KnownMap const& map, Request const& request,
                                           std::vector<Cell> const& path) const {
  std::vector<Cell> best = {path.front()};
  for (std::size_t at = 0; at + 1 < path.size();) {
    std::size_t to = at + 1;
    auto line = straight(path[at], path[to]);
    while (to + 1 < path.size()) {
      auto farther = straight(path[at], path[to + 1]);
      if (!is_as_cheap(map, request, path[at], farther)) break;
      line = std::move(farther);
      ++to;
    }
    best.insert(best.end(), line.begin(), line.end());
    at = to;
  }
  return best;
}

void GridSearch::look_around(KnownMap const& map, Request const& request, std::uint32_t index, Queue& open) {
  auto const cell = map.cell_of(index);
  for (std::uint8_t i = 0; i < 8; ++i) {
    auto const next = cell + neighbours[i];
    if (!map.contains(next)) continue;
    auto& mark = marks_[next];
    if (mark.search == searches_ && mark.is_closed) continue;
    float const step = i < 4 ? 1.0F : std::numbers::sqrt2_v<float>;
    float const so_far = marks_.at_index(index).so_far + step * factor_of(map, next);
    if (mark.search == searches_ && so_far >= mark.so_far) continue;
    if (!is_open(map, next, cell, request)) continue;
    mark = {searches_, so_far, i, false};
    open.push({so_far + octile(next, request.to), static_cast<std::uint32_t>(map.index_of(next))});
  }
}

}  // namespace lapwing::explore
