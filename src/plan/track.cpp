#include "plan/track.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

namespace lapwing::plan {

using base::Duration;
using geo::Ned;

namespace {

Ned difference(Ned a, Ned b) {
  return {a.north - b.north, a.east - b.east, a.down - b.down};
}

double dot(Ned a, Ned b) {
  return a.north * b.north + a.east * b.east + a.down * b.down;
}

Ned between(Ned a, Ned b, double share) {
  auto const way = difference(b, a);
  return {a.north + share * way.north, a.east + share * way.east, a.down + share * way.down};
}

Ned place_between(TrackPoint const& a, TrackPoint const& b, Duration time) {
  if (b.time <= a.time) return b.place_m;
  return between(a.place_m, b.place_m, base::to_seconds(time - a.time) / base::to_seconds(b.time - a.time));
}

/// Reads places off a track at times that never go back.
class Cursor {
 public:
  explicit Cursor(TrackPart track) : track_(track) {}

  Ned place(Duration time) {
    while (next_ + 1 < track_.size() && track_[next_].time < time) ++next_;
    if (next_ == 0 || track_[next_].time <= time) return track_[next_].place_m;
    return place_between(track_[next_ - 1], track_[next_], time);
  }
  /// Of the first point after `time`; nothing behind the last one.
  [[nodiscard]] std::optional<Duration> time_after(Duration time) const {
    for (auto i = next_; i < track_.size(); ++i)
      if (track_[i].time > time) return track_[i].time;
    return std::nullopt;
  }

 private:
  TrackPart track_;
  std::size_t next_ = 0;
};

Approach approach_at(Duration time, Ned first, Ned second) {
  auto const apart = difference(first, second);
  return {.time = time,
          .distance_m = std::sqrt(dot(apart, apart)),
          .level_m = std::hypot(apart.north, apart.east),
          .first_m = first,
          .second_m = second};
}

/// The two moved evenly from `begin` to `end`: their distance squared is a parabola in time.
Approach nearest_within(Approach const& begin, Approach const& end) {
  auto const apart = difference(begin.first_m, begin.second_m);
  auto const change = difference(difference(end.first_m, end.second_m), apart);
  double const speed = dot(change, change);
  double const share = speed > 0.0 ? std::clamp(-dot(apart, change) / speed, 0.0, 1.0) : 0.0;
  auto const time = begin.time + Duration(std::llround(share * static_cast<double>((end.time - begin.time).count())));
  return approach_at(time, between(begin.first_m, end.first_m, share), between(begin.second_m, end.second_m, share));
}

}  // namespace

double length_m(TrackPart track) {
  double length = 0.0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    auto const step = difference(track[i].place_m, track[i - 1].place_m);
    length += std::sqrt(dot(step, step));
  }
  return length;
}

double greatest_height_m(TrackPart track) {
  double highest = 0.0;
  for (auto const& point : track) highest = std::max(highest, -point.place_m.down);
  return highest;
}

Ned place_at(TrackPart track, Duration time) {
  LAPWING_ASSERT(!track.empty());
  auto const after = std::ranges::lower_bound(track, time, {}, &TrackPoint::time);
  if (after == track.end()) return track.back().place_m;
  if (after == track.begin()) return after->place_m;
  return place_between(*(after - 1), *after, time);
}

TrackPart part(TrackPart track, Duration begin, Duration end) {
  auto const first = std::ranges::lower_bound(track, begin, {}, &TrackPoint::time);
  auto const last = std::ranges::upper_bound(first, track.end(), end, {}, &TrackPoint::time);
  return {first, last};
}

std::optional<Duration> left_start(TrackPart track, double distance_m) {
  for (auto const& point : track) {
    auto const way = difference(point.place_m, track.front().place_m);
    if (std::hypot(way.north, way.east) >= distance_m) return point.time;
  }
  return std::nullopt;
}

std::optional<Approach> closest_approach(TrackPart first, TrackPart second) {
  if (first.empty() || second.empty()) return std::nullopt;
  auto time = std::max(first.front().time, second.front().time);
  auto const end = std::min(first.back().time, second.back().time);
  if (end < time) return std::nullopt;
  Cursor a(first);
  Cursor b(second);
  auto before = approach_at(time, a.place(time), b.place(time));
  auto closest = before;
  while (time < end) {
    time = std::min(a.time_after(time).value_or(end), b.time_after(time).value_or(end));
    auto const now = approach_at(time, a.place(time), b.place(time));
    auto const nearest = nearest_within(before, now);
    if (nearest.distance_m < closest.distance_m) closest = nearest;
    before = now;
  }
  return closest;
}

}  // namespace lapwing::plan
