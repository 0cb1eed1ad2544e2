#include "mavlink/path/same_vehicle.hpp"

#include <algorithm>
#include <cmath>

#include "geo/position.hpp"

namespace lapwing::mavlink::internal {

namespace {

using namespace std::chrono_literals;

int constexpr times_in_a_row = 3;
/// What an autopilot may take to answer beyond the link's time: one turn of its slowest loop.
base::Duration constexpr clock_noise = 50ms;
/// Samples of the two paths further apart in time are not compared.
base::Duration constexpr fresh = 1500ms;
double constexpr position_noise_m = 3.0;
/// Of a vehicle that turns hard between two samples.
double constexpr acceleration_m_s2 = 10.0;

enum class Evidence { none, agree, differ };

bool are_comparable(base::TimePoint a, base::TimePoint b, base::TimePoint now) {
  return now - std::min(a, b) <= fresh;
}

Evidence compare_clocks(Fingerprint::Clock const& a, Fingerprint::Clock const& b) {
  return std::chrono::abs(a.boot - b.boot) <= a.error + b.error + clock_noise ? Evidence::agree : Evidence::differ;
}

/// Of both the position is known. How far it can have got between the two moments of its own clock is allowed for.
Evidence compare_places(GlobalPosition const& a, GlobalPosition const& b) {
  double const s = base::to_seconds(b.since_boot - a.since_boot);
  if (std::abs(s) > base::to_seconds(fresh)) return Evidence::none;
  auto const apart_m = geo::surface_distance_m(*a.position, *b.position);
  auto const speed = a.velocity_m_s.value_or(geo::Ned{});
  auto const travelled_m = std::hypot(speed.north, speed.east) * std::abs(s);
  auto const allowed_m = position_noise_m + acceleration_m_s2 * s * s / 2 + travelled_m;
  return apart_m <= allowed_m ? Evidence::agree : Evidence::differ;
}

bool is_known(std::optional<geo::Wgs84> const& place) {
  return place && (place->lat_rad != 0.0 || place->lon_rad != 0.0);
}

}  // namespace

void Fingerprint::take(Timesync const& answer, base::TimePoint now) {
  // A clock of another century is none; and the differences of such would not fit their type.
  constexpr base::Duration century = 24h * 365 * 100;
  if (answer.tc1 < base::Duration{} || answer.tc1 > century) return;
  auto const asked = base::TimePoint(answer.ts1);
  auto const half = (now - asked) / 2;
  clock = Clock{.boot = asked + half - answer.tc1, .error = half, .heard = now};
}

void Fingerprint::take(GlobalPosition const& heard, base::TimePoint now) {
  if (is_known(heard.position)) place = Place{heard, now};
}

void Fingerprint::take(AutopilotVersion const& heard) {
  HardwareNumber const number{heard.uid, heard.uid2};
  if (number != HardwareNumber{}) hardware = number;
}

void SameVehicle::note_copy() {
  if (++copies_ >= times_in_a_row) verdict_ = Verdict::one;
}

void SameVehicle::compare(Fingerprint const& a, Fingerprint const& b, base::TimePoint now) {
  auto hardware = Evidence::none;
  if (a.hardware && b.hardware) hardware = a.hardware == b.hardware ? Evidence::agree : Evidence::differ;
  if (hardware == Evidence::differ) {
    verdict_ = Verdict::two;
    return;
  }
  if (!a.clock || !b.clock) return;
  auto const newest_of_both = std::min(a.clock->heard, b.clock->heard);
  if (newest_of_both <= compared_ || !are_comparable(a.clock->heard, b.clock->heard, now)) return;
  compared_ = newest_of_both;
  auto const clocks = compare_clocks(*a.clock, *b.clock);
  auto places = Evidence::none;
  if (a.place && b.place && are_comparable(a.place->heard, b.place->heard, now))
    places = compare_places(a.place->position, b.place->position);
  if (places != Evidence::none) stand_apart_ = places == Evidence::differ;

  if (clocks == Evidence::differ || places == Evidence::differ) return count(against_, for_, Verdict::two);
  if (stand_apart_) return;  // clocks may be asked more often than positions
  if (hardware == Evidence::agree || places == Evidence::agree) return count(for_, against_, Verdict::one);
}

void SameVehicle::count(int& evidence, int& opposite, Verdict proves) {
  opposite = 0;
  if (++evidence >= times_in_a_row) verdict_ = proves;
}

}  // namespace lapwing::mavlink::internal
