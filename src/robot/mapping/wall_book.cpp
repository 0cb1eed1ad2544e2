#include "robot/mapping/wall_book.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::robot {
namespace {

using slam::WallLine;
using Shift = geo::Vector<map::GridFrame>;

/// How much of the shorter line lies beside the longer one, 0 to 1; 0 when it lies elsewhere or otherwise.
double shared(WallLine const& a, WallLine const& b) {
  constexpr double most_turn = 0.1;
  constexpr double most_beside_m = 0.15;
  auto const& longer = a.length_m() >= b.length_m() ? a : b;
  auto const& shorter = a.length_m() >= b.length_m() ? b : a;
  Shift const along = (longer.to - longer.from) * (1.0 / longer.length_m());
  Shift const way = shorter.to - shorter.from;
  if (std::abs(along.cross(way)) > std::sin(most_turn) * way.length()) return 0.0;
  auto const first = shorter.from - longer.from;
  auto const last = shorter.to - longer.from;
  if (std::max(std::abs(along.cross(first)), std::abs(along.cross(last))) > most_beside_m) return 0.0;
  auto const [low, high] = std::minmax({along.dot(first), along.dot(last)});
  double const both = std::min(high, longer.length_m()) - std::max(low, 0.0);
  return std::max(0.0, both / shorter.length_m());
}

bool has_moved(WallLine const& a, WallLine const& b) {
  constexpr double least_m = 0.02;
  return geo::distance_m(a.from, b.from) > least_m || geo::distance_m(a.to, b.to) > least_m;
}

}  // namespace

WallBook::Changes WallBook::take(std::vector<WallLine> const& found) {
  constexpr double least_shared = 0.5;
  Changes changes;
  auto left = std::exchange(walls_, {});
  for (auto const& line : found) {
    auto const best = std::ranges::max_element(left, {}, [&](Entry const& known) { return shared(known.line, line); });
    if (best == left.end() || shared(best->line, line) < least_shared) {
      walls_.push_back({++last_, line});
      changes.put.push_back(walls_.back());
      continue;
    }
    auto entry = *best;
    left.erase(best);
    if (has_moved(entry.line, line)) {
      entry.line = line;
      changes.put.push_back(entry);
    }
    walls_.push_back(entry);
  }
  for (auto const& [number, line] : left) changes.removed.push_back(number);
  return changes;
}

}  // namespace lapwing::robot
