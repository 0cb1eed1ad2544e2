#include "explore/strategy/gain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <ranges>

#include "explore/floor/ray.hpp"

namespace lapwing::explore {

namespace {

constexpr std::size_t rays = 48;

std::array<Shift, rays> make_directions() {
  std::array<Shift, rays> directions;
  for (std::size_t i = 0; i < rays; ++i) {
    double const yaw = (static_cast<double>(i) + 0.5) * 2.0 * std::numbers::pi / static_cast<double>(rays);
    directions[i] = Shift(std::cos(yaw), std::sin(yaw));
  }
  return directions;
}

}  // namespace

double unknown_beyond_m2(KnownMap const& map, Frontier const& frontier, double reach_m) {
  static std::array<Shift, rays> const directions = make_directions();
  double const reach = reach_m / map.cell_m();
  double sum = 0.0;
  for (auto const& direction : directions) {
    double entered = -1.0;  // where the unknown began that the ray is in
    double last = 0.0;
    walk_line(frontier.middle.x + 0.5, frontier.middle.y + 0.5, direction.x(), direction.y(), reach,
              [&](Cell cell, double at) {
                auto const knowledge = map.at(cell);
                last = at;
                if (knowledge == Knowledge::unknown && entered < 0.0) entered = at;
                if (knowledge != Knowledge::unknown && entered >= 0.0) {
                  sum += at * at - entered * entered;
                  entered = -1.0;
                }
                return knowledge != Knowledge::wall;
              });
    if (entered >= 0.0) sum += last * last - entered * entered;
  }
  return sum * std::numbers::pi / static_cast<double>(rays) * map.cell_m() * map.cell_m();
}

double hidden_m2(KnownMap const& map, std::vector<Frontier> const& frontiers, double reach_m) {
  if (frontiers.empty()) return 0.0;
  DenseGrid<std::uint32_t> hidden_by(map.width(), map.height());  // the number of the last frontier, from 1; 0: none
  std::size_t cells = 0;
  std::uint32_t number = 0;
  for (auto const& frontier : frontiers) {
    ++number;
    double const reach = std::min(2.0 * static_cast<double>(frontier.cells.size()), reach_m / map.cell_m());
    auto const reach2 = static_cast<std::int64_t>(reach * reach);
    std::vector<Cell> open;
    auto const take_neighbours_of = [&](Cell cell) {
      for (auto const& away : neighbours | std::views::take(4)) {
        auto const next = cell + away;
        if (hidden_by.or_else(next, number) == number || map.at(next) != Knowledge::unknown) continue;
        auto const [x, y] = next - frontier.middle;
        if (std::int64_t{x} * x + std::int64_t{y} * y > reach2) continue;
        if (hidden_by[next] == 0) ++cells;
        hidden_by[next] = number;
        open.push_back(next);
      }
    };
    for (auto const index : frontier.cells) take_neighbours_of(map.cell_of(index));
    while (!open.empty()) {
      auto const cell = open.back();
      open.pop_back();
      take_neighbours_of(cell);
    }
  }
  return static_cast<double>(cells) * map.cell_m() * map.cell_m();
}

}  // namespace lapwing::explore
