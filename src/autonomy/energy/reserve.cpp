#include "autonomy/energy/reserve.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::autonomy {

namespace {

/// Less than that over ground is no way home.
double constexpr slowest_m_s = 1.0;
/// Drains above that empty a full battery within 10 s: no measurement.
double constexpr greatest_drain_per_s = 0.1;

double climb_power(ReserveOptions const& options) {
  double const half = options.climb_m_s / (2.0 * options.hover_induced_m_s);
  return half + std::sqrt(half * half + 1.0);
}

/// Round the Earth, and up to where nothing flies.
double constexpr furthest_m = 4e7;
double constexpr highest_m = 1e5;

bool is_sound(WayHome const& way) {
  return way.distance_m >= 0.0 && way.distance_m < furthest_m && std::abs(way.height_m) < highest_m &&
         std::abs(way.return_height_m) < highest_m;
}

bool is_sound(vehicle::Drain const& drain) {
  return drain.per_s > 0.0 && drain.per_s < greatest_drain_per_s && drain.error >= 0.0 && drain.error <= 1.0;
}

}  // namespace

std::optional<base::Duration> hover_time_home(WayHome const& way, ReserveOptions const& options) {
  double const over_ground_m_s = options.cruise_m_s - options.headwind_m_s;
  if (over_ground_m_s < slowest_m_s) return std::nullopt;
  double const height_m = std::max(way.height_m, 0.0);
  double const top_m = std::max(height_m, way.return_height_m);
  double const climb_s = (top_m - height_m) / options.climb_m_s * climb_power(options);
  double const descent_s = std::max(top_m - options.landing_below_m, 0.0) / options.descent_m_s;
  double const landing_s = std::min(top_m, options.landing_below_m) / options.landing_m_s;
  return base::from_seconds(climb_s + way.distance_m / over_ground_m_s + descent_s + landing_s) +
         options.wait_over_home;
}

double reserve(std::optional<WayHome> const& way, std::optional<vehicle::Drain> const& drain,
               ReserveOptions const& options) {
  if (!way || !drain || !is_sound(*way) || !is_sound(*drain)) return options.when_unknown;
  auto const time = hover_time_home(*way, options);
  if (!time) return 1.0;
  double const needed = drain->per_s * (1.0 + drain->error) * base::to_seconds(*time);
  return std::clamp(needed + options.margin, options.least, 1.0);
}

std::optional<base::Duration> flying_time_left(double charge, double height_m, double return_height_m,
                                               std::optional<vehicle::Drain> const& drain,
                                               ReserveOptions const& options) {
  WayHome const over_home{.height_m = height_m, .return_height_m = return_height_m};
  if (!drain || !is_sound(*drain) || !is_sound(over_home)) return std::nullopt;
  double const spare = std::max(0.0, charge - reserve(over_home, drain, options));
  return base::from_seconds(spare / (drain->per_s * (1.0 + drain->error)));
}

}  // namespace lapwing::autonomy
