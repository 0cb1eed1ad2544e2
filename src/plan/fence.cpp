#include "plan/fence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lapwing::plan {

using base::Duration;
using Kind = Zone::Kind;

namespace {

/// Along an edge a vehicle is in and out with every rounding: that is no breach.
constexpr double touching_m = 0.01;
/// The worst moment is the first one: what comes later has to be worse by this much.
constexpr double deeper_m = 0.005;

LevelPoint level(geo::Ned place) {
  return {place.north, place.east};
}

/// A stretch of the track, even motion from one point to the next.
struct Stretch {
  TrackPoint from;
  TrackPoint to;

  [[nodiscard]] TrackPoint at(double share) const {
    auto const& a = from.place_m;
    auto const& b = to.place_m;
    auto const time = Duration(std::llround(share * static_cast<double>((to.time - from.time).count())));
    return {from.time + time,
            {a.north + share * (b.north - a.north), a.east + share * (b.east - a.east),
             a.down + share * (b.down - a.down)}};
  }
};

/// Where the stretch meets the line through the edge within the edge, as a share of the stretch.
std::optional<double> crossing(Stretch const& stretch, LevelPoint a, LevelPoint b) {
  auto const from = level(stretch.from.place_m);
  auto const way = level(stretch.to.place_m) - from;
  auto const edge = b - a;
  double const cross = way.cross(edge);
  if (cross == 0.0) return std::nullopt;  // side by side: it changes sides at the edges that join this one
  auto const gap = a - from;
  double const share = gap.cross(edge) / cross;
  double const along = gap.cross(way) / cross;
  if (share <= 0.0 || share >= 1.0 || along < 0.0 || along > 1.0) return std::nullopt;
  return share;
}

/// A zone and the time in which its lower limit counts.
struct Watched {
  Zone const* zone = nullptr;
  Duration lower_from = Duration::max();
  Duration lower_until = Duration::min();
};

Watched watched(Zone const& zone, TrackPart track) {
  Watched result{&zone};
  if (!zone.lowest_m) return result;
  for (auto const& point : track) {
    if (-point.place_m.down < *zone.lowest_m) continue;
    result.lower_from = std::min(result.lower_from, point.time);
    result.lower_until = std::max(result.lower_until, point.time);
  }
  return result;
}

void add_crossings(Stretch const& stretch, Zone const& zone, std::vector<double>& shares) {
  for (auto const& polygon : zone.polygons)
    for (auto const& ring : polygon.rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (auto const share = crossing(stretch, ring[i], ring[(i + 1) % ring.size()])) shares.push_back(*share);
  double const from_m = -stretch.from.place_m.down;
  double const to_m = -stretch.to.place_m.down;
  for (auto const& limit : {zone.lowest_m, zone.highest_m}) {
    if (!limit || from_m == to_m) continue;
    double const share = (*limit - from_m) / (to_m - from_m);
    if (share > 0.0 && share < 1.0) shares.push_back(share);
  }
}

/// What is wrong at a point; nothing when `depth_m` is empty.
struct Wrong {
  std::optional<double> depth_m;
  bool by_height = false;
  Zone const* zone = nullptr;
};

Wrong outside(Watched const& watched, TrackPoint const& at) {
  auto const& zone = *watched.zone;
  double level_m = zone.polygons.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (auto const& polygon : zone.polygons)
    level_m =
        contains(polygon, level(at.place_m)) ? 0.0 : std::min(level_m, distance_to_edge_m(polygon, level(at.place_m)));
  double const height_m = -at.place_m.down;
  bool const lower_counts = watched.lower_from <= at.time && at.time <= watched.lower_until;
  double vertical_m = 0.0;
  if (zone.highest_m) vertical_m = std::max(0.0, height_m - *zone.highest_m);
  if (zone.lowest_m && lower_counts) vertical_m = std::max(vertical_m, *zone.lowest_m - height_m);
  if (level_m == 0.0 && vertical_m == 0.0) return {};
  return {std::hypot(level_m, vertical_m), vertical_m > level_m, &zone};
}

Wrong inside(Zone const& zone, TrackPoint const& at) {
  double const height_m = -at.place_m.down;
  if (zone.highest_m && height_m > *zone.highest_m) return {};
  if (zone.lowest_m && height_m < *zone.lowest_m) return {};
  double vertical_m = std::numeric_limits<double>::infinity();
  if (zone.highest_m) vertical_m = *zone.highest_m - height_m;
  if (zone.lowest_m) vertical_m = std::min(vertical_m, height_m - *zone.lowest_m);
  for (auto const& polygon : zone.polygons) {
    if (!contains(polygon, level(at.place_m))) continue;
    double const level_m = distance_to_edge_m(polygon, level(at.place_m));
    return {std::min(level_m, vertical_m), vertical_m < level_m, &zone};
  }
  return {};
}

/// What a track must keep to: either all inclusions together, or one exclusion.
struct Rule {
  Kind kind = Kind::inclusion;
  std::vector<Watched> zones;

  [[nodiscard]] Wrong wrong_at(TrackPoint const& point) const {
    if (kind == Kind::exclusion) return inside(*zones.front().zone, point);
    Wrong nearest;
    for (auto const& zone : zones) {
      auto const wrong = outside(zone, point);
      if (!wrong.depth_m) return {};
      if (!nearest.depth_m || *wrong.depth_m < *nearest.depth_m) nearest = wrong;
    }
    return nearest;
  }
};

std::vector<Rule> rules_of(Fence const& fence, TrackPart track) {
  std::vector<Rule> rules;
  Rule inclusions;
  for (auto const& zone : fence.zones) {
    if (zone.kind == Kind::inclusion) inclusions.zones.push_back(watched(zone, track));
    if (zone.kind == Kind::exclusion) rules.push_back({Kind::exclusion, {watched(zone, track)}});
  }
  if (!inclusions.zones.empty()) rules.push_back(std::move(inclusions));
  return rules;
}

/// Follows one track under one rule.
class Examination {
 public:
  explicit Examination(Rule const& rule) : rule_(rule) {}

  void look_at(Stretch const& stretch) {
    shares_.assign({0.0, 1.0});
    for (auto const& watched : rule_.zones) add_crossings(stretch, *watched.zone, shares_);
    std::ranges::sort(shares_);
    for (std::size_t i = 1; i < shares_.size(); ++i) look_between(stretch, shares_[i - 1], shares_[i]);
  }

  std::vector<Breach> take() {
    close();
    return std::move(found_);
  }

 private:
  void look_between(Stretch const& stretch, double from, double to) {
    auto const middle = stretch.at(0.5 * (from + to));
    if (!rule_.wrong_at(middle).depth_m) return close();
    auto const begin = stretch.at(from);
    auto const end = stretch.at(to);
    if (!open_) open_ = Breach{.zone = {}, .kind = rule_.kind, .begin = begin.time, .end = {}, .worst = begin};
    for (auto const& point : {begin, middle, end}) deepen(point);
    open_->end = end.time;
  }

  void deepen(TrackPoint const& point) {
    auto const wrong = rule_.wrong_at(point);
    if (!wrong.depth_m || (!open_->zone.empty() && *wrong.depth_m < open_->depth_m + deeper_m)) return;
    open_->depth_m = *wrong.depth_m;
    open_->by_height = wrong.by_height;
    open_->zone = wrong.zone->name;
    open_->worst = point;
  }

  void close() {
    if (open_ && open_->depth_m >= touching_m) found_.push_back(std::move(*open_));
    open_.reset();
  }

  Rule const& rule_;
  std::vector<double> shares_;
  std::optional<Breach> open_;
  std::vector<Breach> found_;
};

}  // namespace

std::vector<Breach> breaches(TrackPart track, Fence const& fence) {
  std::vector<Breach> all;
  for (auto const& rule : rules_of(fence, track)) {
    Examination examination(rule);
    for (std::size_t i = 1; i < track.size(); ++i) examination.look_at({track[i - 1], track[i]});
    auto found = examination.take();
    all.insert(all.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  }
  std::ranges::stable_sort(all, {}, &Breach::begin);
  return all;
}

}  // namespace lapwing::plan
