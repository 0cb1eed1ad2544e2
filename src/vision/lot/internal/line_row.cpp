#include "vision/lot/internal/line_row.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lapwing::vision::internal {

namespace {

/// Metres, as car parks are built: slots of 2.3 to 3.3 m, wider ones for those who need room, 4.5 to 6 m deep.
constexpr double narrowest_pitch = 2.1;
constexpr double widest_pitch = 3.4;
constexpr double farthest_neighbour = 10.5;  // some lines between are hidden
constexpr double shallowest = 3.2;
constexpr double deepest = 14.0;  // two slots head to head
constexpr double shortest_side = 1.8;
constexpr double same_direction = 0.1;  // radians
constexpr double same_tooth = 0.6;      // both lines of a hairpin

double median(std::vector<double> values) {
  auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

cv::Point2d direction_of(PaintedLine const& line) {
  return (line.to - line.from) * (1.0 / line.length());
}

/// Parallel, a slot or some of them apart, and beside each other for a good part of the longer one.
bool are_neighbours(PaintedLine const& a, PaintedLine const& b) {
  auto const along = direction_of(a);
  auto const other = direction_of(b);
  if (std::abs(along.x * other.y - along.y * other.x) > std::sin(same_direction)) return false;
  auto const between = 0.5 * (b.from + b.to) - 0.5 * (a.from + a.to);
  double const apart = std::abs(along.x * between.y - along.y * between.x);
  if (apart < narrowest_pitch || apart > farthest_neighbour) return false;
  double const shift = along.dot(between);
  double const common =
      std::min(0.5 * a.length(), shift + 0.5 * b.length()) - std::max(-0.5 * a.length(), shift - 0.5 * b.length());
  constexpr double least_share = 0.4;
  constexpr double least_common = 1.2;
  return common > least_common && common > least_share * std::max(a.length(), b.length());
}

std::vector<std::vector<PaintedLine>> families(std::span<PaintedLine const> lines) {
  std::vector<std::size_t> parent(lines.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  auto const root = [&](std::size_t k) {
    while (parent[k] != k) k = parent[k];
    return k;
  };
  for (std::size_t a = 0; a < lines.size(); ++a) {
    for (std::size_t b = a + 1; b < lines.size(); ++b) {
      if (are_neighbours(lines[a], lines[b])) parent[root(a)] = root(b);
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

std::vector<Tooth> teeth_of(std::span<PaintedLine const> family, LineRow const& row) {
  std::vector<Tooth> teeth;
  for (auto const& line : family) {
    auto const [begin, end] = std::minmax({line.from.dot(row.along), line.to.dot(row.along)});
    teeth.push_back({.at = row.across.dot(0.5 * (line.from + line.to)), .begin = begin, .end = end});
  }
  std::ranges::stable_sort(teeth, {}, &Tooth::at);
  std::vector<Tooth> merged;
  for (auto const& tooth : teeth) {
    if (merged.empty() || tooth.at - merged.back().at >= same_tooth) {
      merged.push_back(tooth);
      continue;
    }
    auto& last = merged.back();
    last = {.at = 0.5 * (last.at + tooth.at),
            .begin = std::min(last.begin, tooth.begin),
            .end = std::max(last.end, tooth.end)};
  }
  return merged;
}

std::optional<double> pitch_of(std::span<Tooth const> teeth) {
  std::vector<double> gaps;
  for (std::size_t k = 1; k < teeth.size(); ++k) {
    double const gap = teeth[k].at - teeth[k - 1].at;
    if (gap > narrowest_pitch && gap < widest_pitch) gaps.push_back(gap);
  }
  if (gaps.size() < 2) return std::nullopt;
  return median(std::move(gaps));
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

/// Those whose ends are their own: what is much shorter than others is hidden in part.
std::vector<Tooth> whole_ones(std::span<Tooth const> teeth) {
  std::vector<double> lengths;
  for (auto const& tooth : teeth) lengths.push_back(tooth.length());
  std::ranges::sort(lengths);
  constexpr double long_enough = 0.75;
  double const least = long_enough * lengths[lengths.size() * 4 / 5];
  std::vector<Tooth> whole;
  std::ranges::copy_if(teeth, std::back_inserter(whole), [&](auto const& tooth) { return tooth.length() >= least; });
  return whole;
}

/// By how much both ends shift from place to place, in the median (Theil 1950, Sen 1968): none but in slanted rows.
double slope_of(std::span<Tooth const> teeth) {
  std::vector<double> slopes;
  for (std::size_t a = 0; a < teeth.size(); ++a) {
    for (std::size_t b = a + 1; b < teeth.size(); ++b) {
      double const apart = teeth[b].at - teeth[a].at;
      if (apart <= 1.0) continue;
      slopes.push_back((teeth[b].begin - teeth[a].begin) / apart);
      slopes.push_back((teeth[b].end - teeth[a].end) / apart);
    }
  }
  return slopes.empty() ? 0.0 : median(std::move(slopes));
}

struct Ends {
  Linear begin;
  Linear end;
  double off = 0.0;  ///< how far the ends are from them, in all
};

Ends ends_with(double slope, std::span<Tooth const> teeth) {
  std::vector<double> begins;
  std::vector<double> ends;
  for (auto const& tooth : teeth) {
    begins.push_back(tooth.begin - slope * tooth.at);
    ends.push_back(tooth.end - slope * tooth.at);
  }
  Ends fit{.begin = {slope, median(begins)}, .end = {slope, median(ends)}};
  for (auto const& tooth : teeth)
    fit.off += std::abs(tooth.begin - fit.begin(tooth.at)) + std::abs(tooth.end - fit.end(tooth.at));
  return fit;
}

/// Most rows go straight across their sides; what is hidden of some must not slant them.
Ends ends_of(std::span<Tooth const> teeth) {
  auto const whole = whole_ones(teeth);
  auto const straight = ends_with(0.0, whole);
  auto const slanted = ends_with(slope_of(whole), whole);
  constexpr double much_better = 0.75;
  return slanted.off < much_better * straight.off ? slanted : straight;
}

std::optional<LineRow> row_of(std::span<PaintedLine const> family) {
  LineRow row;
  row.along = common_direction(family);
  row.across = {-row.along.y, row.along.x};
  row.teeth = teeth_of(family, row);
  auto const pitch = pitch_of(row.teeth);
  if (!pitch) return std::nullopt;
  row.pitch = *pitch;
  row.teeth = on_comb(row.teeth, row.pitch);
  if (row.teeth.size() < 3) return std::nullopt;
  auto const ends = ends_of(row.teeth);
  row.begin = ends.begin;
  row.end = ends.end;
  double const middle = row.teeth[row.teeth.size() / 2].at;
  double const depth = row.end(middle) - row.begin(middle);
  if (depth < shallowest || depth > deepest) return std::nullopt;
  return row;
}

}  // namespace

std::vector<LineRow> rows_of(std::span<PaintedLine const> lines) {
  std::vector<PaintedLine> sides;
  std::ranges::copy_if(lines, std::back_inserter(sides), [](PaintedLine const& line) {
    return line.length() > shortest_side && line.length() < deepest;
  });
  std::vector<LineRow> rows;
  for (auto const& family : families(sides)) {
    if (auto row = row_of(family)) rows.push_back(*std::move(row));
  }
  return rows;
}

}  // namespace lapwing::vision::internal
