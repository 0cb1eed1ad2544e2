#include "fleet/watch/place_trace.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace lapwing::fleet {

using vehicle::Family;

namespace {

/// Faster than missions are flown with a wind in the back; what was seen to be faster still counts.
double usual_top_speed_m_s(Family family) {
  switch (family) {
    case Family::rover:
    case Family::boat:
    case Family::sub: return 15.0;
    case Family::copter: return 30.0;
    default: return 60.0;
  }
}

double usual_lag_s(Family family) {
  bool const turns_on_the_spot = family == Family::copter || family == Family::rover || family == Family::sub;
  return turns_on_the_spot ? 1.5 : 4.0;
}

double distance_m(geo::Ned a, geo::Ned b) {
  return std::hypot(a.north - b.north, a.east - b.east);
}

}  // namespace

PlaceTrace::PlaceTrace(std::vector<PlannedPlace> places, Family family)
    : frame_(places.empty() ? geo::Wgs84{} : places.front().at),
      fastest_m_s_(usual_top_speed_m_s(family)),
      lag_s_(usual_lag_s(family)) {
  for (auto const& place : places) {
    seqs_.push_back(place.seq);
    open_.push_back({place.seq, frame_.ned_from(place.at), place.radius_m});
  }
}

int PlaceTrace::note(geo::Wgs84 place, double speed_m_s, base::Duration since_last) {
  if (seqs_.empty()) return 0;
  constexpr double fastest_anything_m_s = 150.0;
  constexpr double reserve = 1.5;
  auto const here = frame_.ned_from(place);
  if (last_ && since_last > base::Duration{})
    speed_m_s = std::max(speed_m_s, distance_m(*last_, here) / base::to_seconds(since_last));
  speed_m_s = std::min(speed_m_s, fastest_anything_m_s);
  fastest_m_s_ = std::max(fastest_m_s_, reserve * speed_m_s);
  double const flown_m = fastest_m_s_ * base::to_seconds(since_last);
  auto const is_passed = [&](Open const& open) {
    double const radius_m = open.radius_m + lag_s_ * speed_m_s;
    double const now_m = distance_m(here, open.at);
    if (now_m <= radius_m) return true;
    return last_ && distance_m(*last_, open.at) + now_m <= flown_m + 2.0 * radius_m;
  };
  auto const passed = std::erase_if(open_, is_passed);
  last_ = here;
  return static_cast<int>(passed);
}

void PlaceTrace::note_reached(int seq) {
  constexpr double not_far = 4.0;
  // The number may be that of a command that stands behind the place.
  auto const after = std::ranges::upper_bound(seqs_, seq);
  if (after == seqs_.begin() || !last_) return;
  std::erase_if(open_, [&](Open const& open) {
    return open.seq == *std::prev(after) && distance_m(*last_, open.at) <= not_far * open.radius_m;
  });
}

std::vector<int> PlaceTrace::unpassed(base::Duration silent_for) const {
  std::vector<int> seqs;
  for (auto const& open : open_)
    if (last_ && distance_m(*last_, open.at) > open.radius_m + fastest_m_s_ * base::to_seconds(silent_for))
      seqs.push_back(open.seq);
  return seqs;
}

std::string items_text(std::vector<int> const& seqs) {
  std::vector<std::string> parts;
  for (auto first = seqs.begin(); first != seqs.end();) {
    auto last = first;
    while (last + 1 != seqs.end() && *(last + 1) == *last + 1) ++last;
    if (last - first > 1) {
      parts.push_back(fmt::format("{} to {}", *first, *last));
    } else {
      for (auto one = first; one <= last; ++one) parts.push_back(std::to_string(*one));
    }
    first = last + 1;
  }
  std::string text = seqs.size() == 1 ? "item " : "items ";
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

}  // namespace lapwing::fleet
