#include "sim/building/sensors/sonar.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace lapwing::sim::building {

namespace {

/// Rays that stand for the cone: at 5 m they are 12 cm apart, less than what is to be found is wide.
constexpr int rays = 11;
/// Met more aslant than this a smooth surface sends nothing back.
constexpr double most_aslant_on_plaster_rad = 0.35;
constexpr double most_aslant_on_wood_rad = 0.45;
/// So near to a face's end there is an edge or a corner.
constexpr double edge_m = 0.03;
/// An edge is a faint source: it is heard in the nearer part of the range.
constexpr double edge_range = 0.4;
constexpr double cloth_range = 0.5;
constexpr double us_per_m = 147.0 / 0.0254;

Shift unit(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

bool sends_back(Hit const& hit, Shift const& way, double range_m) {
  if (hit.material == Material::cloth) return hit.range_m < cloth_range * range_m;
  if (hit.to_edge_m < edge_m && hit.range_m < edge_range * range_m) return true;
  bool const is_smooth = hit.material == Material::plaster || hit.material == Material::glass;
  double const most = is_smooth ? most_aslant_on_plaster_rad : most_aslant_on_wood_rad;
  return -way.dot(hit.normal) > std::cos(most);
}

}  // namespace

std::uint16_t echo_us(SonarSettings const& settings, Place const& from, double yaw_rad, Surroundings const& around,
                      Noise& noise) {
  double const luck = noise.uniform();
  double const second_luck = noise.uniform();
  double const error_m = settings.noise_m * noise.gaussian();
  double nearest_m = std::numeric_limits<double>::infinity();
  std::optional<Hit> mirror;
  Shift mirrored_way;
  for (int i = 0; i < rays; ++i) {
    auto const way = unit(yaw_rad + settings.half_cone_rad * (2.0 * i / (rays - 1) - 1.0));
    auto const hit = around.cast(from, way, settings.range_m);
    if (!hit) continue;
    if (sends_back(*hit, way, settings.range_m)) {
      nearest_m = std::min(nearest_m, hit->range_m);
    } else if (!mirror || hit->range_m < mirror->range_m) {
      mirror = hit;
      mirrored_way = way;
    }
  }
  if (!std::isfinite(nearest_m) && mirror && second_luck < settings.second_echo) {
    auto const bounce = from + (mirror->range_m - 1e-6) * mirrored_way;
    auto const on = mirrored_way - 2.0 * mirrored_way.dot(mirror->normal) * mirror->normal;
    double const left_m = settings.range_m - mirror->range_m;
    if (auto const second = around.cast(bounce, on, left_m); second && sends_back(*second, on, settings.range_m))
      nearest_m = mirror->range_m + second->range_m;
  }
  if (!std::isfinite(nearest_m) || luck < settings.lost) return 0;
  double const range_m = nearest_m + error_m;
  if (range_m < settings.shortest_m) return static_cast<std::uint16_t>(std::lround(settings.shortest_m * us_per_m));
  return range_m > settings.range_m ? std::uint16_t{0} : static_cast<std::uint16_t>(std::lround(range_m * us_per_m));
}

}  // namespace lapwing::sim::building
