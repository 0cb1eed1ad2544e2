#include "robot/mapping/wall_book.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lapwing::robot {
namespace {

using slam::WallLine;
using Shift = geo::Vector<map::GridFrame>;

/// How two lines lie to each other.
struct Likeness {
  double shared = 0.0;    ///< how much of the shorter lies along the longer one, 0 to 1; 0 where it lies otherwise
  double beside_m = 0.0;  ///< how far beside it
};

Likeness likeness(WallLine const& a, WallLine const& b) {
  constexpr double most_turn = 0.1;
  constexpr double most_beside_m = 0.15;
  auto const& longer = a.length_m() >= b.length_m() ? a : b;
  auto const& shorter = a.length_m() >= b.length_m() ? b : a;
  Shift const along = (longer.to - longer.from) * (1.0 / longer.length_m());
  Shift const way = shorter.to - shorter.from;
  if (std::abs(along.cross(way)) > std::sin(most_turn) * way.length()) return {};
  auto const first = shorter.from - longer.from;
  auto const last = shorter.to - longer.from;
  double const beside_m = std::max(std::abs(along.cross(first)), std::abs(along.cross(last)));
  if (beside_m > most_beside_m) return {};
  auto const [low, high] = std::minmax({along.dot(first), along.dot(last)});
  double const both = std::min(high, longer.length_m()) - std::max(low, 0.0);
  return {.shared = std::max(0.0, both / shorter.length_m()), .beside_m = beside_m};
}

/// Beside each other lie the two faces of a thin wall, too: of those that share enough the nearest is the same.
double distance_to(WallBook::Entry const& known, WallLine const& line) {
  constexpr double least_shared = 0.5;
  auto const like = likeness(known.line, line);
  return like.shared < least_shared ? std::numeric_limits<double>::infinity() : like.beside_m;
}

bool has_moved(WallLine const& a, WallLine const& b) {
  constexpr double least_m = 0.02;
  return geo::distance_m(a.from, b.from) > least_m || geo::distance_m(a.to, b.to) > least_m;
}

}  // namespace

WallBook::Changes WallBook::take(std::vector<WallLine> const& found) {
  Changes changes;
  auto left = std::exchange(walls_, {});
  for (auto const& line : found) {
    auto const best = std::ranges::min_element(left, {}, [&](Entry const& known) { return distance_to(known, line); });
    if (best == left.end() || std::isinf(distance_to(*best, line))) {
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
