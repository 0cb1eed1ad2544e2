#include "vision/lot/layout.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "vision/lot/internal/line_row.hpp"

namespace lapwing::vision {

namespace {

using internal::LineRow;
using internal::Parking;
using internal::Tooth;

/// Along the row, in metres.
bool is_as_wide_as_slots(double width, Parking parking) {
  bool const is_in_line = parking == Parking::in_line;
  double const narrowest = is_in_line ? 4.4 : 2.0;
  double const widest = is_in_line ? 8.5 : 4.3;
  return width >= narrowest && width <= widest;
}

/// A place of the row's comb; what is painted there, if anything.
struct Side {
  double at = 0.0;
  std::optional<Tooth> painted{};
  bool is_lone_gap = false;  ///< the only one that is missing between two that are painted
};

/// The part of the sides that one slot takes.
struct Depth {
  double begin = 0.0;
  double end = 1.0;
};

std::vector<Depth> depths_of(LineRow const& row) {
  if (!row.head) return {{0.0, 1.0}};
  return {{0.0, *row.head}, {*row.head, 1.0}};
}

/// All of it on the car or close beside it: a sill, a roof rail, the edge of a window. Paint beside a car is longer.
bool is_edge_of(TurnedBox car, PaintedLine const& line) {
  constexpr double beside = 0.2;  // what stands up is seen aslant: sills lie beside the box of the roof
  constexpr double beyond = 0.1;
  car.width += 2.0 * beside;
  car.length += 2.0 * beyond;
  return contains(car, {line.from.x, line.from.y}) && contains(car, {line.to.x, line.to.y});
}

bool is_on_car(PaintedLine const& line, std::span<TurnedBox const> cars) {
  constexpr int tries = 15;
  constexpr double most = 0.6;
  // Boxes of cars reach to their mirrors and a little farther: the paint beside them stays.
  constexpr double inner = 0.8;
  int covered = 0;
  for (int k = 0; k < tries; ++k) {
    auto const at = line.from + (line.to - line.from) * (static_cast<double>(k) / (tries - 1));
    if (std::ranges::any_of(cars, [&](TurnedBox car) {
          car.width *= inner;
          return contains(car, {at.x, at.y});
        }))
      ++covered;
  }
  return covered >= most * tries ||
         std::ranges::any_of(cars, [&](TurnedBox const& car) { return is_edge_of(car, line); });
}

/// Whether a car between two places of the row looks that way, within the part of its depth.
bool has_car_along(cv::Point2d const& way, LineRow const& row, double from, double to, Depth const& depth,
                   std::span<TurnedBox const> cars) {
  double const middle = 0.5 * (from + to);
  double const direction = std::atan2(way.y, way.x);
  constexpr double most_aside = 0.35;  // of the width
  constexpr double most_turned = 0.35;
  return std::ranges::any_of(cars, [&](TurnedBox const& car) {
    cv::Point2d const at(car.middle.x, car.middle.y);
    double const aside = std::abs(at.dot(row.across) - middle);
    double const deep = (at.dot(row.along) - row.begin(middle)) / (row.end(middle) - row.begin(middle));
    bool const is_parallel = std::abs(std::sin(car.heading_rad - direction)) < std::sin(most_turned);
    return is_parallel && aside < most_aside * (to - from) && deep > depth.begin && deep < depth.end;
  });
}

/// Whether a car stands between two places of the row, as it would in a slot.
bool has_car(LineRow const& row, double from, double to, Depth const& depth, std::span<TurnedBox const> cars) {
  return has_car_along(row.parking == Parking::in_line ? row.across : row.along, row, from, to, depth, cars);
}

/// Paint between cars that stand side by side may lie as far apart as slots that are in line: some of it is hidden.
bool is_contradicted(LineRow const& row, std::span<TurnedBox const> cars) {
  constexpr Depth around{.begin = -0.6, .end = 1.6};
  constexpr double beside = 1.5;  // the part of a row that `has_car_along` leaves out at its ends, and more
  double const more = beside * row.pitch;
  return row.parking == Parking::in_line &&
         has_car_along(row.along, row, row.teeth.front().at - more, row.teeth.back().at + more, around, cars);
}

/// The painted sides, those that must stand between them by the pitch, and those that cars show beyond the last ones.
std::vector<Side> comb_of(LineRow const& row, std::span<Depth const> depths, std::span<TurnedBox const> cars) {
  constexpr int most_hidden = 7;
  std::vector<Side> comb;
  for (auto const& tooth : row.teeth) {
    if (!comb.empty()) {
      double const last = comb.back().at;
      double const gap = tooth.at - last;
      int const steps = static_cast<int>(std::lround(gap / row.pitch));
      bool const fits = std::abs(gap - steps * row.pitch) < 0.12 * steps * row.pitch + 0.2;
      for (int k = 1; fits && steps <= most_hidden && k < steps; ++k)
        comb.push_back({.at = last + gap * k / steps, .is_lone_gap = steps == 2});
    }
    comb.push_back({.at = tooth.at, .painted = tooth});
  }
  auto const stands = [&](double from) {
    return std::ranges::any_of(depths,
                               [&](Depth const& depth) { return has_car(row, from, from + row.pitch, depth, cars); });
  };
  constexpr int most_beyond = 4;
  for (int k = 0; k < most_beyond && stands(comb.front().at - row.pitch); ++k)
    comb.insert(comb.begin(), {.at = comb.front().at - row.pitch});
  for (int k = 0; k < most_beyond && stands(comb.back().at); ++k) comb.push_back({.at = comb.back().at + row.pitch});
  return comb;
}

/// Whether the paint goes along a good part of the slot.
bool is_painted(LineRow const& row, Side const& side, Depth const& depth) {
  if (!side.painted) return false;
  double const begin = row.begin(side.at);
  double const whole = row.end(side.at) - begin;
  double const low = begin + depth.begin * whole;
  double const high = begin + depth.end * whole;
  constexpr double least_share = 0.3;
  return std::min(side.painted->end, high) - std::max(side.painted->begin, low) > least_share * (high - low);
}

/// Three or more lines slantwise in it.
bool is_hatched(SlotShape const& slot, std::span<PaintedLine const> lines) {
  auto const middle = slot.middle();
  auto const deep = slot.corners[2] - slot.corners[1];
  auto const wide = slot.corners[1] - slot.corners[0];
  constexpr double least_slant = 0.3;
  constexpr double most_slant = 0.95;
  auto const count = std::ranges::count_if(lines, [&](PaintedLine const& line) {
    auto const way = line.to - line.from;
    double const slant = std::abs(way.x * deep.y - way.y * deep.x) / (line.length() * cv::norm(deep));
    auto const at = 0.5 * (line.from + line.to) - middle;
    bool const is_inside =
        std::abs(at.dot(deep)) < 0.5 * deep.dot(deep) && std::abs(at.dot(wide)) < 0.5 * wide.dot(wide);
    return is_inside && slant > least_slant && slant < most_slant;
  });
  return count >= 3;
}

/// What speaks for a slot.
struct Signs {
  int painted_sides = 0;
  bool has_car = false;
  bool is_lone_gap = false;  ///< of its other side
  bool is_long_row = false;
};

/// How sure a slot is, none if it is none.
std::optional<double> surety_of(Signs const& signs) {
  constexpr double painted = 0.95;
  constexpr double half_painted = 0.9;
  constexpr double by_rest = 0.6;
  if (signs.painted_sides == 2) return painted;
  if (signs.painted_sides == 1 && signs.has_car) return half_painted;
  if (signs.painted_sides == 1 && signs.is_lone_gap && signs.is_long_row) return by_rest;
  return signs.has_car && signs.is_long_row ? std::optional(by_rest) : std::nullopt;
}

void add_slots(LineRow const& row, std::span<TurnedBox const> cars, std::vector<SlotShape>& slots) {
  auto const depths = depths_of(row);
  auto const comb = comb_of(row, depths, cars);
  constexpr std::size_t long_row = 5;
  for (std::size_t k = 1; k < comb.size(); ++k) {
    auto const& first = comb[k - 1];
    auto const& second = comb[k];
    if (!is_as_wide_as_slots(second.at - first.at, row.parking)) continue;
    for (auto const& depth : depths) {
      int const painted = (is_painted(row, first, depth) ? 1 : 0) + (is_painted(row, second, depth) ? 1 : 0);
      auto const surety = surety_of({.painted_sides = painted,
                                     .has_car = has_car(row, first.at, second.at, depth, cars),
                                     .is_lone_gap = first.is_lone_gap || second.is_lone_gap,
                                     .is_long_row = comb.size() > long_row});
      if (!surety) continue;
      slots.push_back({.corners = {row.point(first.at, depth.begin), row.point(second.at, depth.begin),
                                   row.point(second.at, depth.end), row.point(first.at, depth.end)},
                       .surety = *surety});
    }
  }
}

bool is_on(SeenGround const& seen, SlotShape const& slot) {
  constexpr double most_outside = 0.3;
  return std::ranges::all_of(slot.corners, [&](auto const& corner) { return seen.inside_by(corner) > -most_outside; });
}

}  // namespace

std::vector<SlotShape> slots_between(std::span<PaintedLine const> lines, std::span<TurnedBox const> cars,
                                     SeenGround const& seen) {
  std::vector<PaintedLine> sides;
  std::ranges::copy_if(lines, std::back_inserter(sides), [&](auto const& line) { return !is_on_car(line, cars); });
  std::vector<SlotShape> all;
  for (auto const& row : internal::rows_of(sides, seen))
    if (!is_contradicted(row, cars)) add_slots(row, cars, all);
  std::erase_if(all, [&](SlotShape const& slot) { return is_hatched(slot, sides) || !is_on(seen, slot); });
  // Rows that share a slot: the surer one has it.
  std::ranges::stable_sort(all, std::ranges::greater(), &SlotShape::surety);
  constexpr double same_slot = 1.3;
  std::vector<SlotShape> kept;
  for (auto const& slot : all) {
    bool const is_told = std::ranges::any_of(
        kept, [&](SlotShape const& other) { return cv::norm(other.middle() - slot.middle()) < same_slot; });
    if (!is_told) kept.push_back(slot);
  }
  return kept;
}

}  // namespace lapwing::vision
