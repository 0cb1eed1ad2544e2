#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bus/messages/common.hpp"

/// sensor_msgs, as far as robots and drones need it.
namespace lapwing::bus {

/// Beam i looks `angle_min + i * angle_increment`, counterclockwise from ahead.
struct LaserScan {
  Header header = {};  ///< the moment of the first beam
  float angle_min = 0.0F;
  float angle_max = 0.0F;
  float angle_increment = 0.0F;
  float time_increment = 0.0F;  ///< seconds from beam to beam
  float scan_time = 0.0F;       ///< seconds from scan to scan
  float range_min = 0.0F;
  float range_max = 0.0F;
  std::vector<float> ranges = {};  ///< metres; below range_min or beyond range_max says nothing
  std::vector<float> intensities = {};
  friend bool operator==(LaserScan const&, LaserScan const&) = default;
};
template <>
struct Description<LaserScan> {
  static constexpr std::string_view name = "sensor_msgs/msg/LaserScan";
  static constexpr auto fields = std::tuple{Field{"header", &LaserScan::header},
                                            Field{"angle_min", &LaserScan::angle_min},
                                            Field{"angle_max", &LaserScan::angle_max},
                                            Field{"angle_increment", &LaserScan::angle_increment},
                                            Field{"time_increment", &LaserScan::time_increment},
                                            Field{"scan_time", &LaserScan::scan_time},
                                            Field{"range_min", &LaserScan::range_min},
                                            Field{"range_max", &LaserScan::range_max},
                                            Field{"ranges", &LaserScan::ranges},
                                            Field{"intensities", &LaserScan::intensities}};
};

/// What is not known is not a number.
struct BatteryState {
  Header header = {};
  float voltage = 0.0F;
  float temperature = 0.0F;
  float current = 0.0F;
  float charge = 0.0F;
  float capacity = 0.0F;
  float design_capacity = 0.0F;
  float percentage = 0.0F;  ///< 0..1
  std::uint8_t power_supply_status = 0;
  std::uint8_t power_supply_health = 0;
  std::uint8_t power_supply_technology = 0;
  bool present = false;
  std::vector<float> cell_voltage = {};
  std::vector<float> cell_temperature = {};
  std::string location = {};
  std::string serial_number = {};
  friend bool operator==(BatteryState const&, BatteryState const&) = default;
};
template <>
struct Description<BatteryState> {
  static constexpr std::string_view name = "sensor_msgs/msg/BatteryState";
  static constexpr auto fields = std::tuple{Field{"header", &BatteryState::header},
                                            Field{"voltage", &BatteryState::voltage},
                                            Field{"temperature", &BatteryState::temperature},
                                            Field{"current", &BatteryState::current},
                                            Field{"charge", &BatteryState::charge},
                                            Field{"capacity", &BatteryState::capacity},
                                            Field{"design_capacity", &BatteryState::design_capacity},
                                            Field{"percentage", &BatteryState::percentage},
                                            Field{"power_supply_status", &BatteryState::power_supply_status},
                                            Field{"power_supply_health", &BatteryState::power_supply_health},
                                            Field{"power_supply_technology", &BatteryState::power_supply_technology},
                                            Field{"present", &BatteryState::present},
                                            Field{"cell_voltage", &BatteryState::cell_voltage},
                                            Field{"cell_temperature", &BatteryState::cell_temperature},
                                            Field{"location", &BatteryState::location},
                                            Field{"serial_number", &BatteryState::serial_number}};
};

struct NavSatStatus {
  static constexpr std::int8_t no_fix = -1;
  static constexpr std::int8_t fix = 0;
  std::int8_t status = no_fix;
  std::uint16_t service = 0;  ///< bits: 1 GPS, 2 GLONASS, 4 Compass, 8 Galileo
  friend bool operator==(NavSatStatus const&, NavSatStatus const&) = default;
};
template <>
struct Description<NavSatStatus> {
  static constexpr std::string_view name = "sensor_msgs/msg/NavSatStatus";
  static constexpr auto fields =
      std::tuple{Field{"status", &NavSatStatus::status}, Field{"service", &NavSatStatus::service}};
};

struct NavSatFix {
  Header header = {};
  NavSatStatus status = {};
  double latitude = 0.0;   ///< degrees, as ROS has it
  double longitude = 0.0;  ///< degrees
  double altitude = 0.0;   ///< metres above the ellipsoid; not a number where it is not known
  std::array<double, 9> position_covariance = {};
  std::uint8_t position_covariance_type = 0;  ///< 0: not known
  friend bool operator==(NavSatFix const&, NavSatFix const&) = default;
};
template <>
struct Description<NavSatFix> {
  static constexpr std::string_view name = "sensor_msgs/msg/NavSatFix";
  static constexpr auto fields = std::tuple{Field{"header", &NavSatFix::header},
                                            Field{"status", &NavSatFix::status},
                                            Field{"latitude", &NavSatFix::latitude},
                                            Field{"longitude", &NavSatFix::longitude},
                                            Field{"altitude", &NavSatFix::altitude},
                                            Field{"position_covariance", &NavSatFix::position_covariance},
                                            Field{"position_covariance_type", &NavSatFix::position_covariance_type}};
};

}  // namespace lapwing::bus
