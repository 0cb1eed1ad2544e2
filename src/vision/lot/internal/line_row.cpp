#include "vision/lot/internal/line_row.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/median.hpp"

namespace lapwing::vision::internal {

namespace {

/// Metres, as car parks are built.
struct Measures {
  double narrowest_pitch;
  double widest_pitch;
  double farthest_neighbour;  ///< some lines between are hidden
  double shortest_side;
  double shallowest;
  double deepest;
  double usual_depth;
};

Measures measures_of(Parking parking) {
  // Slots of 2.3 to 3.3 m, wider ones for those who need room, 4.5 to 6 m deep, two of them head to head.
  if (parking == Parking::side_by_side)
    return {.narrowest_pitch = 2.1,
            .widest_pitch = 3.4,
            .farthest_neighbour = 10.5,
            .shortest_side = 1.8,
            .shallowest = 3.2,
            .deepest = 14.0,
            .usual_depth = 5.0};
  // As long as a car and its way out, 1.8 to 2.7 m deep.
  return {.narrowest_pitch = 4.8,
          .widest_pitch = 7.5,
          .farthest_neighbour = 15.5,
          .shortest_side = 1.4,
          .shallowest = 1.5,
          .deepest = 3.1,
          .usual_depth = 2.2};
}

constexpr double deepest_slot = 7.6;    // what is deeper is two slots head to head
constexpr double same_direction = 0.1;  // radians
constexpr double same_tooth = 0.6;      // both lines of a hairpin

cv::Point2d direction_of(PaintedLine const& line) {
  return (line.to - line.from) * (1.0 / line.length());
}

/// Parallel, a slot or some of them apart, and beside each other for a good part of the longer one.
bool are_neighbours(PaintedLine const& a, PaintedLine const& b, Measures const& measures) {
  auto const along = direction_of(a);
  auto const other = direction_of(b);
  if (std::abs(along.x * other.y - along.y * other.x) > std::sin(same_direction)) return false;
  auto const between = 0.5 * (b.from + b.to) - 0.5 * (a.from + a.to);
  double const apart = std::abs(along.x * between.y - along.y * between.x);
  if (apart < measures.narrowest_pitch || apart > measures.farthest_neighbour) return false;
  double const shift = along.dot(between);
  double const common =
      std::min(0.5 * a.length(), shift + 0.5 * b.length()) - std::max(-0.5 * a.length(), shift - 0.5 * b.length());
  constexpr double least_share = 0.4;
  constexpr double least_common = 1.2;
  return common > least_common && common > least_share * std::max(a.length(), b.length());
}

std::vector<std::vector<PaintedLine>> families(std::span<PaintedLine const> lines, Measures const& measures) {
  std::vector<std::size_t> parent(lines.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  auto const root = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k];
    return k;
  };
  for (std::size_t a = 0; a < lines.size(); ++a) {
    for (std::size_t b = a + 1; b < lines.size(); ++b) {
      if (are_neighbours(lines[a], lines[b], measures)) parent[root(a)] = root(b);
    }
  }
  std::vector<std::vector<PaintedLine>> all(lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k) all[root(k)].push_back(lines[k]);
  std::erase_if(all, [](auto const& family) { return family.size() < 3; });
  return all;
}

/// The mean direction, weighed by length; opposite ways are one.
cv::Point2d common_direction(std::span<PaintedLine const> family) {
  cv::Point2d doubled(0.0, 0.0);
  for (auto const& line : family) {
    auto const way = direction_of(line);
    doubled += line.length() * cv::Point2d(way.x * way.x - way.y * way.y, 2.0 * way.x * way.y);
  }
  double const angle = 0.5 * std::atan2(doubled.y, doubled.x);
  return {std::cos(angle), std::sin(angle)};
}

Tooth tooth_of(PaintedLine line, LineRow const& row, SeenGround const& seen) {
  if (line.from.dot(row.along) > line.to.dot(row.along)) std::swap(line.from, line.to);
  // Lines are told up to where what is on both of their sides can be compared.
  constexpr double near = 0.4;
  return {.at = row.across.dot(0.5 * (line.from + line.to)),
          .begin = line.from.dot(row.along),
          .end = line.to.dot(row.along),
          .is_begin_cut = seen.inside_by(line.from - near * row.along) < 0.0,
          .is_end_cut = seen.inside_by(line.to + near * row.along) < 0.0};
}

/// Two pieces of one side.
Tooth joined(Tooth const& a, Tooth const& b) {
  auto const& first = a.begin < b.begin ? a : b;
  auto const& last = a.end > b.end ? a : b;
  return {.at = 0.5 * (a.at + b.at),
          .begin = first.begin,
          .end = last.end,
          .is_begin_cut = first.is_begin_cut,
          .is_end_cut = last.is_end_cut};
}

std::vector<Tooth> teeth_of(std::span<PaintedLine const> family, LineRow const& row, SeenGround const& seen) {
  std::vector<Tooth> teeth;
  for (auto const& line : family) teeth.push_back(tooth_of(line, row, seen));
  std::ranges::stable_sort(teeth, {}, &Tooth::at);
  std::vector<Tooth> merged;
  for (auto const& tooth : teeth) {
    if (merged.empty() || tooth.at - merged.back().at >= same_tooth) {
      merged.push_back(tooth);
      continue;
    }
    merged.back() = joined(merged.back(), tooth);
  }
  return merged;
}

std::optional<double> pitch_of(std::span<Tooth const> teeth, Measures const& measures) {
  std::vector<double> gaps;
  for (std::size_t k = 1; k < teeth.size(); ++k) {
    double const gap = teeth[k].at - teeth[k - 1].at;
    if (gap > measures.narrowest_pitch && gap < measures.widest_pitch) gaps.push_back(gap);
  }
  if (gaps.size() < 2) return std::nullopt;
  return base::median(std::move(gaps));
}

/// How many others stand whole pitches away, and how long it is: edges of cars that stand side by side have a pitch,
/// too, but are short.
double standing(Tooth const& tooth, std::span<Tooth const> teeth, double pitch) {
  constexpr double farthest = 4.5;
  constexpr double off_comb = 0.16;
  constexpr double long_enough = 6.0;
  double count = 0.0;
  for (auto const& other : teeth) {
    double const steps = std::abs(other.at - tooth.at) / pitch;
    if (steps > 0.5 && steps < farthest && std::abs(steps - std::round(steps)) < off_comb) count += 1.0;
  }
  return count + std::min(tooth.length(), long_enough);
}

/// Of teeth that are too near to each other the better one.
std::vector<Tooth> on_comb(std::span<Tooth const> teeth, double pitch) {
  auto const rank = [&](Tooth const& tooth) { return standing(tooth, teeth, pitch); };
  constexpr double too_near = 0.72;
  std::vector<Tooth> kept;
  for (auto const& tooth : teeth) {
    if (kept.empty() || tooth.at - kept.back().at >= too_near * pitch) {
      kept.push_back(tooth);
    } else if (rank(tooth) > rank(kept.back())) {
      kept.back() = tooth;
    }
  }
  return kept;
}

/// Where many sides begin or end.
struct Common {
  double at = 0.0;
  std::size_t count = 0;
};

/// `values`: where each side ends, `outward` 1 or -1. Cars hide some ends, joints of the ground prolong others, mostly
/// each by a length of its own: of the places where many agree the outermost is the paint's end.
Common common_of(std::span<double const> values, double outward) {
  if (values.empty()) return {};
  constexpr double same_place = 0.3;
  std::vector<Common> places;
  for (double const value : values) {
    auto& place = places.emplace_back();
    for (double const other : values) {
      if (std::abs(other - value) > same_place) continue;
      place.at += other;
      ++place.count;
    }
    place.at /= static_cast<double>(place.count);
  }
  auto const most = std::ranges::max(places, {}, &Common::count).count;
  constexpr std::size_t at_least = 3;
  auto const enough = std::min(most, std::max(at_least, 2 * most / 5));
  std::erase_if(places, [&](auto const& place) { return place.count < enough; });
  return std::ranges::max(places, {}, [&](auto const& place) { return outward * place.at; });
}

/// Where both ends of the sides lie if they shift by `slope` from place to place.
struct Ends {
  double slope = 0.0;
  Common begin;
  Common end;

  [[nodiscard]] std::size_t agreed() const { return begin.count + end.count; }
};

Ends ends_with(double slope, std::span<Tooth const> teeth) {
  std::vector<double> begins;
  std::vector<double> ends;
  for (auto const& tooth : teeth) {
    if (!tooth.is_begin_cut) begins.push_back(tooth.begin - slope * tooth.at);
    if (!tooth.is_end_cut) ends.push_back(tooth.end - slope * tooth.at);
  }
  return {.slope = slope, .begin = common_of(begins, -1.0), .end = common_of(ends, 1.0)};
}

/// From where one side ends to where the other does; nothing where the picture cuts one of them off.
std::optional<double> shift_of(Tooth const& from, Tooth const& to, double Tooth::* side, bool Tooth::* is_cut) {
  if (from.*is_cut || to.*is_cut) return std::nullopt;
  return to.*side - from.*side;
}

/// Most rows go straight across their sides. Slanted ones shift as some two of their sides do, and most others agree.
/// None where several ends are seen and no two agree: then too little of a slanted row is seen to tell how it lies.
std::optional<Ends> ends_of(std::span<Tooth const> teeth) {
  auto const straight = ends_with(0.0, teeth);
  auto best = straight;
  constexpr double steepest = 1.2;
  for (std::size_t a = 0; a < teeth.size(); ++a) {
    for (std::size_t b = a + 1; b < teeth.size(); ++b) {
      double const apart = teeth[b].at - teeth[a].at;
      if (apart <= 1.0) continue;
      for (auto const shift : {shift_of(teeth[a], teeth[b], &Tooth::begin, &Tooth::is_begin_cut),
                               shift_of(teeth[a], teeth[b], &Tooth::end, &Tooth::is_end_cut)}) {
        if (!shift || std::abs(*shift) > steepest * apart) continue;
        auto const slanted = ends_with(*shift / apart, teeth);
        if (slanted.agreed() > best.agreed()) best = slanted;
      }
    }
  }
  // The two that tell a slope do not speak for it.
  constexpr double telling = 2.0;
  constexpr double clearly = 1.3;
  bool const is_slanted =
      static_cast<double>(best.agreed()) - telling > clearly * static_cast<double>(straight.agreed());
  if (is_slanted) return best;
  bool const is_straight = straight.begin.count > 1 || straight.end.count > 1;
  bool const shows_several = std::ranges::count(teeth, false, &Tooth::is_begin_cut) > 1 ||
                             std::ranges::count(teeth, false, &Tooth::is_end_cut) > 1;
  return is_straight || !shows_several ? std::optional(straight) : std::nullopt;
}

/// Kerbs and walls beside the row are parallel to its sides, too, but go beyond them at one end and not to the other.
void drop_beside(LineRow& row) {
  constexpr double beyond = 0.8;
  constexpr double short_of = 0.5;
  auto const is_beside = [&](Tooth const& tooth) {
    double const before = row.begin(tooth.at) - tooth.begin;
    double const after = tooth.end - row.end(tooth.at);
    return (before > beyond && std::abs(after) > short_of) || (after > beyond && std::abs(before) > short_of);
  };
  while (row.teeth.size() > 3 && is_beside(row.teeth.front())) row.teeth.erase(row.teeth.begin());
  while (row.teeth.size() > 3 && is_beside(row.teeth.back())) row.teeth.pop_back();
}

/// A line along the row, where heads meet: by its place at the row's `begin` 0 and at its `end` 1. None if nothing is
/// painted there.
std::optional<double> spine_of(LineRow const& row, std::span<PaintedLine const> lines) {
  auto const way = row.across + row.begin.slope * row.along;
  double const first = row.teeth.front().at;
  double const last = row.teeth.back().at;
  std::vector<double> places;
  double covered = 0.0;
  for (auto const& line : lines) {
    auto const direction = direction_of(line);
    if (std::abs(direction.x * way.y - direction.y * way.x) > std::sin(same_direction) * cv::norm(way)) continue;
    auto const middle = 0.5 * (line.from + line.to);
    double const at = middle.dot(row.across);
    double const share = (middle.dot(row.along) - row.begin(at)) / (row.end(at) - row.begin(at));
    constexpr double outermost = 0.35;
    if (at < first || at > last || share < outermost || share > 1.0 - outermost) continue;
    places.push_back(share);
    covered += line.length();
  }
  constexpr double least_share = 0.2;
  if (covered < least_share * (last - first)) return std::nullopt;
  return base::median(std::move(places));
}

/// Two rows head to head are equally deep: where the sides say otherwise, what more of them agree on tells the other.
void even_out(LineRow& row, Ends const& ends, double head_share) {
  double const whole = row.end.offset - row.begin.offset;
  double const head = row.begin.offset + head_share * whole;
  constexpr double as_deep = 0.4;
  if (std::abs((1.0 - 2.0 * head_share) * whole) > as_deep) {
    if (ends.begin.count > ends.end.count) {
      row.end.offset = 2.0 * head - row.begin.offset;
    } else if (ends.end.count > ends.begin.count) {
      row.begin.offset = 2.0 * head - row.end.offset;
    }
  }
  row.head = (head - row.begin.offset) / (row.end.offset - row.begin.offset);
}

/// Where nearly all sides are cut off, those that seem to end there say nothing.
bool is_known(Common const& ends, std::span<Tooth const> teeth, bool Tooth::* is_cut) {
  auto const cut = static_cast<std::size_t>(std::ranges::count_if(teeth, is_cut));
  return ends.count >= 3 || ends.count > cut;
}

/// How far the picture shows the sides of which it does not show the end.
double shown_to(std::span<Tooth const> teeth, double slope, double Tooth::* side, double outward) {
  double farthest = -1e18;
  for (auto const& tooth : teeth) farthest = std::max(farthest, outward * (tooth.*side - slope * tooth.at));
  return outward * farthest;
}

/// A row whose sides the picture cuts off at one end: by the line where heads meet, or as deep as most slots are.
bool close_end(LineRow& row, Ends const& ends, std::span<PaintedLine const> lines) {
  bool const knows_begin = is_known(ends.begin, row.teeth, &Tooth::is_begin_cut);
  bool const knows_end = is_known(ends.end, row.teeth, &Tooth::is_end_cut);
  if (knows_begin && knows_end) return true;
  if (!knows_begin && !knows_end) return false;
  if (knows_begin)
    row.end.offset = shown_to(row.teeth, ends.slope, &Tooth::end, 1.0);
  else
    row.begin.offset = shown_to(row.teeth, ends.slope, &Tooth::begin, -1.0);
  double const usual_depth = measures_of(row.parking).usual_depth;
  double const shown = row.end.offset - row.begin.offset;
  if (shown < usual_depth) return false;
  double depth = usual_depth;
  if (auto const head = spine_of(row, lines)) depth = (knows_begin ? *head : 1.0 - *head) * shown;
  if (knows_begin)
    row.end.offset = row.begin.offset + depth;
  else
    row.begin.offset = row.end.offset - depth;
  return true;
}

std::optional<LineRow> row_of(std::span<PaintedLine const> family, std::span<PaintedLine const> lines,
                              SeenGround const& seen, Parking parking) {
  auto const measures = measures_of(parking);
  LineRow row;
  row.parking = parking;
  row.along = common_direction(family);
  row.across = {-row.along.y, row.along.x};
  row.teeth = teeth_of(family, row, seen);
  auto const pitch = pitch_of(row.teeth, measures);
  if (!pitch) return std::nullopt;
  row.pitch = *pitch;
  row.teeth = on_comb(row.teeth, row.pitch);
  if (row.teeth.size() < 3) return std::nullopt;
  auto const ends = ends_of(row.teeth);
  if (!ends) return std::nullopt;
  row.begin = {.slope = ends->slope, .offset = ends->begin.at};
  row.end = {.slope = ends->slope, .offset = ends->end.at};
  if (!close_end(row, *ends, lines)) return std::nullopt;
  double const depth = row.end.offset - row.begin.offset;
  if (depth < measures.shallowest || depth > measures.deepest) return std::nullopt;
  drop_beside(row);
  if (depth >= deepest_slot) {
    row.head = 0.5;
    if (auto const head = spine_of(row, lines)) even_out(row, *ends, *head);
  }
  return row;
}

/// Whether a line's middle lies within the row or half a slot beside it.
bool is_in(PaintedLine const& line, LineRow const& row) {
  auto const middle = 0.5 * (line.from + line.to);
  double const at = middle.dot(row.across);
  double const along = middle.dot(row.along);
  double const beside = 0.5 * row.pitch;
  return at > row.teeth.front().at - beside && at < row.teeth.back().at + beside && along > row.begin(at) &&
         along < row.end(at);
}

}  // namespace

std::vector<LineRow> rows_of(std::span<PaintedLine const> lines, SeenGround const& seen) {
  std::vector<LineRow> rows;
  for (auto const parking : {Parking::side_by_side, Parking::in_line}) {
    auto const measures = measures_of(parking);
    auto const known = rows;
    std::vector<PaintedLine> sides;
    std::ranges::copy_if(lines, std::back_inserter(sides), [&](PaintedLine const& line) {
      return line.length() > measures.shortest_side && line.length() < measures.deepest &&
             std::ranges::none_of(known, [&](LineRow const& row) { return is_in(line, row); });
    });
    for (auto const& family : families(sides, measures)) {
      if (auto row = row_of(family, lines, seen, parking)) rows.push_back(*std::move(row));
    }
  }
  return rows;
}

}  // namespace lapwing::vision::internal
