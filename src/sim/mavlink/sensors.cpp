#include "sim/mavlink/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include <fmt/core.h>

#include "mavlink/wire/raw_message.hpp"
#include "sim/mavlink/speed_controllers.hpp"

namespace lapwing::sim {

using mavlink::RawField;
using vehicle::Family;

namespace {

constexpr double gravity_m_s2 = 9.80665;

struct Vector {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// From north, east, down to the body's forward, right, down.
Vector in_the_body(geo::Ned v, vehicle::Attitude const& attitude) {
  double const cr = std::cos(attitude.roll_rad);
  double const sr = std::sin(attitude.roll_rad);
  double const cp = std::cos(attitude.pitch_rad);
  double const sp = std::sin(attitude.pitch_rad);
  double const cy = std::cos(attitude.yaw_rad);
  double const sy = std::sin(attitude.yaw_rad);
  double const ahead = v.north * cy + v.east * sy;
  double const aside = v.east * cy - v.north * sy;
  double const down = ahead * sp + v.down * cp;
  return {ahead * cp - v.down * sp, aside * cr + down * sr, down * cr - aside * sr};
}

/// What an accelerometer feels: what holds the body up and moves it, not its weight.
Vector specific_force(Body const& body) {
  auto const& a = body.accel_m_s2;
  return in_the_body({a.north, a.east, a.down - gravity_m_s2}, body.attitude);
}

Vector turn_rates(Body const& body) {
  return in_the_body({0.0, 0.0, body.yaw_rate_rad_s}, {body.attitude.roll_rad, body.attitude.pitch_rad, 0.0});
}

/// In milligauss: a dipole along the earth's axis.
Vector field(Body const& body, double lat_rad) {
  constexpr double at_the_equator = 310.0;
  return in_the_body({at_the_equator * std::cos(lat_rad), 0.0, 2.0 * at_the_equator * std::sin(lat_rad)},
                     body.attitude);
}

/// Of the standard atmosphere.
double pressure_hpa(double alt_m) {
  return 1013.25 * std::pow(1.0 - alt_m / 44330.77, 5.25588);
}

std::int64_t whole(double value) {
  return std::llround(value);
}

std::int64_t degrees_e7(double rad) {
  return whole(rad * 180.0 / std::numbers::pi * 1e7);
}

using Fields = std::vector<RawField>;

class Instruments {
 public:
  Instruments(ReportView const& view, ServoOutputs::Pulses const& outputs)
      : view_(view), body_(view.autopilot.body()), outputs_(outputs), place_(view.site.place_at(body_.position_m)) {}

  [[nodiscard]] std::optional<mavlink::Frame> read(mavlink::MessageId id) const {
    switch (static_cast<std::uint32_t>(id)) {
      case 27: return message("RAW_IMU", with(timed_us(), imu()));
      case 29: return message("SCALED_PRESSURE", pressure());
      case 36: return message("SERVO_OUTPUT_RAW", servos());
      case 116: return message("SCALED_IMU2", with(timed_ms(), imu()));
      case 125: return message("POWER_STATUS", {{"Vcc", std::int64_t{5000}}, {"Vservo", std::int64_t{0}}});
      case 137: return message("SCALED_PRESSURE2", pressure());
      case 152: return message("MEMINFO", {{"freemem", std::int64_t{65535}}, {"freemem32", std::int64_t{131072}}});
      case 163: return message("AHRS", {{"error_rp", 0.002}, {"error_yaw", 0.003}});
      case 164: return message("SIMSTATE", simulated());
      case 178: return message("AHRS2", second_estimate());
      case 241: return message("VIBRATION", with(timed_us(), vibration()));
      case 11030: return speed_controllers();
      default: return std::nullopt;
    }
  }

 private:
  [[nodiscard]] std::optional<mavlink::Frame> message(std::string_view name, Fields const& fields) const {
    auto frame = mavlink::raw_message(name, fields, {view_.system_id, mavlink::autopilot_component}, {});
    return frame ? std::optional(*frame) : std::nullopt;
  }
  static Fields with(Fields first, Fields const& rest) {
    first.insert(first.end(), rest.begin(), rest.end());
    return first;
  }
  [[nodiscard]] std::int64_t since_boot_ms() const {
    return std::chrono::duration_cast<std::chrono::milliseconds>(view_.autopilot.now()).count();
  }
  [[nodiscard]] Fields timed_ms() const { return {{"time_boot_ms", since_boot_ms()}}; }
  [[nodiscard]] Fields timed_us() const { return {{"time_usec", since_boot_ms() * 1000}}; }

  [[nodiscard]] Fields imu() const {
    auto const force = specific_force(body_);
    auto const rates = turn_rates(body_);
    auto const mag = field(body_, place_.lat_rad);
    auto const milli_g = [](double m_s2) { return whole(std::clamp(m_s2 / gravity_m_s2, -16.0, 16.0) * 1000.0); };
    constexpr std::int64_t warm = 4500;  // hundredths of a degree Celsius
    return {{"xacc", milli_g(force.x)},
            {"yacc", milli_g(force.y)},
            {"zacc", milli_g(force.z)},
            {"xgyro", whole(rates.x * 1000.0)},
            {"ygyro", whole(rates.y * 1000.0)},
            {"zgyro", whole(rates.z * 1000.0)},
            {"xmag", whole(mag.x)},
            {"ymag", whole(mag.y)},
            {"zmag", whole(mag.z)},
            {"temperature", warm}};
  }
  [[nodiscard]] Fields pressure() const {
    constexpr std::int64_t warm = 3500;
    constexpr double half_air_density = 0.6125;
    bool const has_pitot = view_.autopilot.airframe().family == Family::plane;
    double const ram_pa = has_pitot ? half_air_density * body_.airspeed_m_s * body_.airspeed_m_s : 0.0;
    return with(timed_ms(),
                {{"press_abs", pressure_hpa(place_.alt_m)}, {"press_diff", ram_pa * 0.01}, {"temperature", warm}});
  }
  [[nodiscard]] Fields servos() const {
    // Of 32 bits: it begins anew after 71 minutes.
    Fields fields{{"time_usec", since_boot_ms() * 1000 % (std::int64_t{1} << 32U)}};
    for (std::size_t i = 0; i < outputs_.size(); ++i)
      fields.push_back({fmt::format("servo{}_raw", i + 1), std::int64_t{outputs_[i]}});
    return fields;
  }
  /// Motors shake the body, in m/s²; the ground shakes a rover.
  [[nodiscard]] Fields vibration() const {
    bool const turns = view_.autopilot.armed();
    double const shaken = turns ? 0.8 + 0.05 * view_.autopilot.battery().current_a() : 0.01;
    return {{"vibration_x", shaken}, {"vibration_y", shaken}, {"vibration_z", 1.2 * shaken}};
  }
  /// Of the motors on the first four outputs, a plane's on the third; a rover in the loop has no speed controllers that
  /// speak.
  [[nodiscard]] std::optional<mavlink::Frame> speed_controllers() const {
    auto const family = view_.autopilot.airframe().family;
    auto const& battery = view_.autopilot.battery();
    SpeedControllers told{.voltage_v = battery.voltage_v()};
    if (family == Family::copter || family == Family::sub) {
      for (std::size_t motor = 0; motor < 4; ++motor) told.throttle[motor] = throttle_of(outputs_[motor]);
    } else if (family == Family::plane) {
      told.throttle[2] = throttle_of(outputs_[2]);
    } else {
      return std::nullopt;
    }
    told.current_a = battery.current_a();
    told.updates = static_cast<std::uint16_t>(since_boot_ms() / 4);
    return speed_controller_report(told, {view_.system_id, mavlink::autopilot_component});
  }
  [[nodiscard]] static double throttle_of(int pulse_us) { return std::max(0, pulse_us - 1000) * 1e-3; }
  [[nodiscard]] Fields attitude() const {
    return {{"roll", body_.attitude.roll_rad}, {"pitch", body_.attitude.pitch_rad}, {"yaw", body_.attitude.yaw_rad}};
  }
  [[nodiscard]] Fields place() const {
    return {{"lat", degrees_e7(place_.lat_rad)}, {"lng", degrees_e7(place_.lon_rad)}};
  }
  [[nodiscard]] Fields second_estimate() const { return with(with(attitude(), place()), {{"altitude", place_.alt_m}}); }
  [[nodiscard]] Fields simulated() const {
    auto const force = specific_force(body_);
    auto const rates = turn_rates(body_);
    return with(with(attitude(), place()), {{"xacc", force.x},
                                            {"yacc", force.y},
                                            {"zacc", force.z},
                                            {"xgyro", rates.x},
                                            {"ygyro", rates.y},
                                            {"zgyro", rates.z}});
  }

  ReportView const& view_;
  Body const& body_;
  ServoOutputs::Pulses const& outputs_;
  geo::Wgs84 place_;
};

}  // namespace

std::optional<mavlink::Frame> sensor_report(mavlink::MessageId id, ReportView const& view,
                                            ServoOutputs::Pulses const& outputs) {
  if (view.autopilot.kind().is_px4() || !view.autopilot.navigation().position_known) return std::nullopt;
  return Instruments(view, outputs).read(id);
}

}  // namespace lapwing::sim
