#include "sim/building/sensors/laser.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace lapwing::sim::building {

namespace {

/// Met more aslant than this glass lets the light through, and what stands behind it is seen (Wang and Wang 2017,
/// "Detecting glass in simultaneous localisation and mapping": some degrees about the normal are left).
constexpr double most_aslant_on_glass_rad = 0.09;
constexpr int most_panes = 8;
/// Ranges of neighbouring beams on one surface are not so far apart but where it is met very aslant.
constexpr int edge_mm = 100;

/// The first thing that sends light back.
std::optional<Hit> cast_light(Place from, Shift const& way, double range_m, Surroundings const& around) {
  double before_m = 0.0;
  for (int panes = 0; panes <= most_panes; ++panes) {
    auto hit = around.cast(from, way, range_m - before_m);
    if (!hit) return std::nullopt;
    before_m += hit->range_m;
    bool const goes_through =
        hit->material == Material::glass && -way.dot(hit->normal) < std::cos(most_aslant_on_glass_rad);
    if (!goes_through) {
      hit->range_m = before_m;
      return hit;
    }
    constexpr double inside_m = 1e-6;
    from = from + (hit->range_m + inside_m) * way;
  }
  return std::nullopt;
}

}  // namespace

LaserSettings wide_scanner() {
  return {.spot_rad = 0.005};
}

LaserSettings half_scanner(double x_m) {
  return {.beams = 180,
          .x_m = x_m,
          .first_angle_rad = -std::numbers::pi / 2.0,
          .step_rad = std::numbers::pi / 179.0,
          .range_m = 8.0,
          .duration_s = 0.05};
}

LaserSettings tof_ring() {
  return {.beams = 4,
          .first_angle_rad = 0.0,
          .step_rad = std::numbers::pi / 2.0,
          .range_m = 4.0,
          .shortest_m = 0.03,
          .duration_s = 0.0,
          .noise_m = 0.015,
          .noise_per_m = 0.01,
          .lost = 0.01};
}

Laser::Laser(LaserSettings const& settings, std::uint64_t seed, std::uint32_t robot)
    : settings_(settings), noise_(seed, "laser", robot) {}

std::uint16_t Laser::range_mm(Place const& from, double yaw_rad, Surroundings const& around) {
  auto const hit = cast_light(from, {std::cos(yaw_rad), std::sin(yaw_rad)}, settings_.range_m, around);
  // Chance is asked alike whatever was hit, so that one thing more in the building changes few beams.
  double const luck = noise_.uniform();
  double const error = noise_.gaussian();
  if (!hit) return 0;
  double const far = hit->range_m / settings_.range_m;
  double const lost =
      hit->material == Material::dark ? std::min(1.0, 2.0 * far * settings_.lost_on_dark) : settings_.lost;
  if (luck < lost) return 0;
  double const range_m = hit->range_m + (settings_.noise_m + settings_.noise_per_m * hit->range_m) * error;
  if (range_m < settings_.shortest_m || range_m > settings_.range_m) return 0;
  return static_cast<std::uint16_t>(std::lround(range_m * 1e3));
}

std::uint16_t Laser::mixed_mm(std::uint16_t last_mm, std::uint16_t range_mm) {
  if (settings_.spot_rad == 0.0) return range_mm;
  double const luck = noise_.uniform();
  double const share = noise_.uniform();
  bool const is_edge_between = last_mm > 0 && range_mm > 0 && std::abs(last_mm - range_mm) > edge_mm;
  // The edge is anywhere between the two; this often it is within the beam.
  if (!is_edge_between || luck * settings_.step_rad >= settings_.spot_rad) return range_mm;
  return static_cast<std::uint16_t>(std::lround(last_mm + share * (range_mm - last_mm)));
}

bool Laser::sense(double now_s, Pose const& body, Surroundings const& around) {
  if (settings_.beams == 0) return false;
  Shift const ahead(std::cos(body.yaw_rad), std::sin(body.yaw_rad));
  Shift const aside(-ahead.y(), ahead.x());
  auto const from = body.position + settings_.x_m * ahead + settings_.y_m * aside;
  double const a_beam_s = settings_.duration_s / settings_.beams;
  constexpr double tolerance_s = 1e-9;
  while (begun_.ranges_mm.size() < settings_.beams &&
         begun_.time_s + a_beam_s * static_cast<double>(begun_.ranges_mm.size()) <= now_s + tolerance_s) {
    double const yaw =
        body.yaw_rad + settings_.first_angle_rad + settings_.step_rad * static_cast<double>(begun_.ranges_mm.size());
    if (begun_.ranges_mm.empty()) last_mm_ = 0;
    auto const next_mm = range_mm(from, yaw, around);
    begun_.ranges_mm.push_back(mixed_mm(std::exchange(last_mm_, next_mm), next_mm));
  }
  if (begun_.ranges_mm.size() < settings_.beams) return false;
  std::swap(whole_, begun_);
  begun_.time_s = whole_.time_s + std::max(settings_.period_s, settings_.duration_s);
  begun_.ranges_mm.clear();
  return true;
}

}  // namespace lapwing::sim::building
