#pragma once

#include <numbers>
#include <string_view>

/// What can be, by kind of quantity, in SI units. Wide enough for every vehicle that is built, narrow enough that the
/// ends of the wire's types, by which many a vehicle says "unknown", lie outside. What is outside is no measurement:
/// the codec leaves it out (intake.hpp).
namespace lapwing::mavlink::internal {

struct Range {
  double lowest;
  double highest;
  std::string_view unit = {};
};

namespace limit {

inline constexpr double pi = std::numbers::pi;
inline constexpr double rounding = 1e-9;  ///< of 90 degrees made from 1e-7 degrees

inline constexpr Range latitude_rad{-pi / 2 - rounding, pi / 2 + rounding, "rad"};
inline constexpr Range longitude_rad{-pi - rounding, pi + rounding, "rad"};
inline constexpr Range altitude_m{-12'000.0, 60'000.0, "m"};  ///< from the deepest trench to the highest balloon
inline constexpr Range offset_m{-2.1e7, 2.1e7, "m"};          ///< half around the earth
inline constexpr Range range_m{0.0, 655.4, "m"};              ///< as far as the wire holds
inline constexpr Range accuracy_m{0.0, 1e6, "m"};             ///< worse is none
inline constexpr Range speed_m_s{0.0, 300.0, "m/s"};          ///< nothing that speaks MAVLink breaks the sound barrier
inline constexpr Range velocity_m_s{-300.0, 300.0, "m/s"};    ///< one component
/// ArduPlane sends hundredths of what the message asks for.
inline constexpr Range airspeed_error{-30'000.0, 30'000.0, "m/s"};
inline constexpr Range wind_speed_m_s{0.0, 150.0, "m/s"};
inline constexpr Range wind_m_s{-150.0, 150.0, "m/s"};     ///< beyond any storm
inline constexpr Range angle_rad{-4 * pi, 4 * pi, "rad"};  ///< some count on beyond a turn
inline constexpr Range bearing_rad{0.0, 2 * pi + rounding, "rad"};
inline constexpr Range turn_rate_rad_s{-100.0, 100.0, "rad/s"};  ///< three times what gyroscopes measure
inline constexpr Range fraction{0.0, 1.0};
inline constexpr Range load{0.0, 2.0};  ///< of a main loop that may be late
inline constexpr Range voltage_v{0.0, 1000.0, "V"};
inline constexpr Range current_a{-100.0, 1000.0, "A"};  ///< below zero while it is charged
inline constexpr Range charge_ah{0.0, 2000.0, "Ah"};
inline constexpr Range energy_j{0.0, 1e9, "J"};
inline constexpr Range temperature_c{-100.0, 200.0, "degrees Celsius"};
inline constexpr Range remaining_s{0.0, 7 * 86'400.0, "s"};
inline constexpr Range dilution{0.0, 100.0};
inline constexpr Range test_ratio{0.0, 1e9};              ///< of an estimator's innovations; a lost one's grows far
inline constexpr Range utc_s{946'684'800.0, 4.2e9, "s"};  ///< from 2000 to 2103
inline constexpr Range quaternion_norm{0.8, 1.2};         ///< squared

}  // namespace limit
}  // namespace lapwing::mavlink::internal
