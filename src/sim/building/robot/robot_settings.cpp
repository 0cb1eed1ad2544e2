#include "sim/building/robot/robot_settings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::sim::building {

RobotSettings RobotSettings::of_radius(double radius_m) {
  RobotSettings settings;
  double const times = radius_m / settings.drive.radius_m;
  settings.drive.radius_m = radius_m;
  settings.drive.wheel_base_m *= times;
  settings.sonars = seed_sonars(radius_m);
  return settings;
}

std::vector<SonarSettings> RobotSettings::seed_sonars(double radius_m) {
  constexpr double ahead_m = 7.5;
  constexpr double aside_m = 5.0;
  double const rim_m = radius_m - 0.01;
  std::vector<SonarSettings> sonars;
  for (double const degrees : {0.0, 30.0, -30.0, 90.0, -90.0}) {
    double const angle = degrees * std::numbers::pi / 180.0;
    sonars.push_back({.x_m = rim_m * std::cos(angle),
                      .y_m = rim_m * std::sin(angle),
                      .angle_rad = angle,
                      .range_m = degrees == 0.0 ? ahead_m : aside_m});
  }
  return sonars;
}

std::vector<CameraSettings> RobotSettings::seed_side_cameras() {
  std::vector<CameraSettings> cameras;
  for (double const yaw_rad : {0.87, -0.87, 1.8, -1.8}) {
    cameras.emplace_back();
    cameras.back().yaw_rad = yaw_rad;
    cameras.back().pitch_rad = 0.35;
  }
  return cameras;
}

firmware::Description description_of(RobotSettings const& settings) {
  auto const number = [](double value) { return static_cast<float>(value); };
  firmware::Description body;
  body.wheel_base_m = number(settings.drive.wheel_base_m);
  body.pulses_per_m = number(settings.drive.pulses_per_m);
  body.top_speed_m_s = number(settings.top_speed_m_s);
  body.braking_m_s2 = number(settings.braking_m_s2);
  float const radius_m = number(settings.drive.radius_m);
  body.hull = {.front_m = radius_m, .back_m = radius_m, .half_width_m = radius_m};
  body.sonar_count = static_cast<std::uint8_t>(std::min(settings.sonars.size(), firmware::most_sonars));
  for (std::size_t i = 0; i < body.sonar_count; ++i) {
    auto const& sonar = settings.sonars[i];
    body.sonars[i] = {.x_m = number(sonar.x_m),
                      .y_m = number(sonar.y_m),
                      .angle_rad = number(sonar.angle_rad),
                      .half_cone_rad = number(sonar.half_cone_rad),
                      .longest_m = number(sonar.range_m)};
  }
  auto const& laser = settings.laser;
  body.laser = {.beams = laser.beams,
                .x_m = number(laser.x_m),
                .y_m = number(laser.y_m),
                .first_angle_rad = number(laser.first_angle_rad),
                .step_rad = number(laser.step_rad),
                .longest_m = number(laser.range_m),
                .scan_duration_s = number(laser.duration_s)};
  return body;
}

}  // namespace lapwing::sim::building
