#include "firmware/carrier/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::firmware {

namespace {

/// What a laser sees so far inside of the hull is the body itself.
float constexpr own_body_m = 0.02F;

/// The direction within a sonar's cone that is nearest to the body's axis, ahead or back.
float inner_edge(SonarPlace const& sonar) {
  float const axis = std::abs(sonar.angle_rad) > std::numbers::pi_v<float> / 2
                         ? std::copysign(std::numbers::pi_v<float>, sonar.angle_rad)
                         : 0.0F;
  return sonar.angle_rad + std::clamp(axis - sonar.angle_rad, -sonar.half_cone_rad, sonar.half_cone_rad);
}

}  // namespace

Surroundings::Surroundings(Description const& description, Tuning const& tuning)
    : description_(description), half_path_m_(description.hull.half_width_m + tuning.side_margin_m) {}

void Surroundings::narrow(Clearance& clearance, float x_m, float y_m) const {
  if (std::abs(y_m) > half_path_m_) return;
  if (x_m >= 0)
    clearance.ahead_m = std::min(clearance.ahead_m, x_m - description_.hull.front_m);
  else
    clearance.back_m = std::min(clearance.back_m, -x_m - description_.hull.back_m);
}

bool Surroundings::is_inside(float x_m, float y_m) const {
  auto const& hull = description_.hull;
  return x_m < hull.front_m - own_body_m && x_m > own_body_m - hull.back_m &&
         std::abs(y_m) < hull.half_width_m - own_body_m;
}

void Surroundings::hear(std::span<std::uint16_t const> echoes_us) {
  by_sonar_ = {};
  auto const sonars = description_.sonar_places();
  for (std::size_t i = 0; i < std::min(sonars.size(), echoes_us.size()); ++i) {
    if (echoes_us[i] == no_echo_us) continue;
    auto const& sonar = sonars[i];
    float const range_m = static_cast<float>(echoes_us[i]) / echo_us_per_m;
    if (range_m > sonar.longest_m) continue;
    for (float const angle : {sonar.angle_rad, inner_edge(sonar)}) {
      narrow(by_sonar_, sonar.x_m + range_m * std::cos(angle), sonar.y_m + range_m * std::sin(angle));
    }
  }
}

void Surroundings::see(LaserScan const& scan, float way_m) {
  by_laser_ = {};
  scanned_at_m_ = way_m;
  auto const& laser = description_.laser;
  auto const beams = std::min(scan.ranges_mm.size(), static_cast<std::size_t>(laser.beams));
  for (std::size_t i = 0; i < beams; ++i) {
    float const range_m = static_cast<float>(scan.ranges_mm[i]) * 1e-3F;
    if (range_m == 0 || range_m > laser.longest_m) continue;
    float const angle = laser.first_angle_rad + static_cast<float>(i) * laser.step_rad;
    float const x_m = laser.x_m + range_m * std::cos(angle);
    float const y_m = laser.y_m + range_m * std::sin(angle);
    if (!is_inside(x_m, y_m)) narrow(by_laser_, x_m, y_m);
  }
}

Clearance Surroundings::clearance(float way_m) const {
  float const gone_m = way_m - scanned_at_m_;
  return {.ahead_m = std::min(by_sonar_.ahead_m, by_laser_.ahead_m - gone_m),
          .back_m = std::min(by_sonar_.back_m, by_laser_.back_m + gone_m)};
}

}  // namespace lapwing::firmware
