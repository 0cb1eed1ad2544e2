#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace lapwing::firmware {

// The body's frame: origin in the middle of the axle, x ahead, y to the left, angles to the left.

std::size_t constexpr most_sonars = 8;
std::size_t constexpr most_beams = 2048;
/// What a sonar's pulse width tells: 147 us for each inch of range.
float constexpr echo_us_per_m = 147.0F / 0.0254F;

/// Where a sonar looks from, and how.
struct SonarPlace {
  float x_m = 0;
  float y_m = 0;
  float angle_rad = 0;
  float half_cone_rad = 0;  ///< from the axis to the cone's edge
  float longest_m = 0;      ///< beyond it there is no echo
  friend bool operator==(SonarPlace const&, SonarPlace const&) = default;
};

/// A scanner, or a ring of single ranges at equal angles. No beams: there is none.
struct LaserPlace {
  std::uint16_t beams = 0;
  float x_m = 0;
  float y_m = 0;
  float first_angle_rad = 0;
  float step_rad = 0;  ///< from beam to beam; negative where it turns to the right
  float longest_m = 0;
  float scan_duration_s = 0;  ///< from the first beam to the last
  friend bool operator==(LaserPlace const&, LaserPlace const&) = default;
};

/// What must touch nothing, as seen from the axle's middle. Round enough to turn on the spot wherever it can stand.
struct Hull {
  float front_m = 0;
  float back_m = 0;  ///< positive
  float half_width_m = 0;
  friend bool operator==(Hull const&, Hull const&) = default;
};

/// What a board knows of its body, and a host must know to understand it.
struct Description {
  float wheel_base_m = 0;  ///< between the wheels' tracks
  float pulses_per_m = 0;  ///< of way of one wheel, each edge that is counted
  float top_speed_m_s = 0;
  float braking_m_s2 = 0;
  Hull hull;
  std::uint8_t sonar_count = 0;
  std::array<SonarPlace, most_sonars> sonars{};
  LaserPlace laser;

  [[nodiscard]] std::span<SonarPlace const> sonar_places() const { return std::span(sonars).first(sonar_count); }
  friend bool operator==(Description const&, Description const&) = default;
};

}  // namespace lapwing::firmware
