#pragma once

#include <cstdint>
#include <string>

#include "bus/messages/geographic.hpp"

/// mavros_msgs: how a MAVLink flight controller looks on the bus.
namespace lapwing::bus {

namespace mavros {

/// What the flight controller is about, as its heartbeat tells.
struct State {
  Header header = {};
  bool connected = false;
  bool armed = false;
  bool guided = false;             ///< programs may steer it
  bool manual_input = false;       ///< a pilot may
  std::string mode = {};           ///< as its autopilot names it: "GUIDED"
  std::uint8_t system_status = 0;  ///< MAV_STATE
  friend bool operator==(State const&, State const&) = default;
};

/// Where it returns to.
struct HomePosition {
  Header header = {};
  GeoPoint geo = {};
  Point position = {};  ///< in the local frame: east, north, up
  Quaternion orientation = {};
  Vector3 approach = {};
  friend bool operator==(HomePosition const&, HomePosition const&) = default;
};

/// Units are those of MAVLink's SYS_STATUS.
struct SysStatus {
  Header header = {};
  std::uint32_t sensors_present = 0;  ///< MAV_SYS_STATUS_SENSOR
  std::uint32_t sensors_enabled = 0;
  std::uint32_t sensors_health = 0;
  std::uint16_t load = 0;             ///< thousandths
  std::uint16_t voltage_battery = 0;  ///< millivolts
  std::int16_t current_battery = 0;   ///< hundredths of an ampere; -1: not known
  std::int8_t battery_remaining = 0;  ///< percent; -1: not known
  std::uint16_t drop_rate_comm = 0;
  std::uint16_t errors_comm = 0;
  std::uint16_t errors_count1 = 0;
  std::uint16_t errors_count2 = 0;
  std::uint16_t errors_count3 = 0;
  std::uint16_t errors_count4 = 0;
  friend bool operator==(SysStatus const&, SysStatus const&) = default;
};

/// Its own words.
struct StatusText {
  Header header = {};
  std::uint8_t severity = 0;  ///< MAV_SEVERITY: 0 emergency to 7 debug
  std::string text = {};
  friend bool operator==(StatusText const&, StatusText const&) = default;
};

}  // namespace mavros

template <>
struct Description<mavros::State> {
  static constexpr std::string_view name = "mavros_msgs/msg/State";
  static constexpr auto fields = std::tuple{Field{"header", &mavros::State::header},
                                            Field{"connected", &mavros::State::connected},
                                            Field{"armed", &mavros::State::armed},
                                            Field{"guided", &mavros::State::guided},
                                            Field{"manual_input", &mavros::State::manual_input},
                                            Field{"mode", &mavros::State::mode},
                                            Field{"system_status", &mavros::State::system_status}};
};
template <>
struct Description<mavros::HomePosition> {
  static constexpr std::string_view name = "mavros_msgs/msg/HomePosition";
  static constexpr auto fields = std::tuple{
      Field{"header", &mavros::HomePosition::header}, Field{"geo", &mavros::HomePosition::geo},
      Field{"position", &mavros::HomePosition::position}, Field{"orientation", &mavros::HomePosition::orientation},
      Field{"approach", &mavros::HomePosition::approach}};
};
template <>
struct Description<mavros::SysStatus> {
  static constexpr std::string_view name = "mavros_msgs/msg/SysStatus";
  static constexpr auto fields = std::tuple{Field{"header", &mavros::SysStatus::header},
                                            Field{"sensors_present", &mavros::SysStatus::sensors_present},
                                            Field{"sensors_enabled", &mavros::SysStatus::sensors_enabled},
                                            Field{"sensors_health", &mavros::SysStatus::sensors_health},
                                            Field{"load", &mavros::SysStatus::load},
                                            Field{"voltage_battery", &mavros::SysStatus::voltage_battery},
                                            Field{"current_battery", &mavros::SysStatus::current_battery},
                                            Field{"battery_remaining", &mavros::SysStatus::battery_remaining},
                                            Field{"drop_rate_comm", &mavros::SysStatus::drop_rate_comm},
                                            Field{"errors_comm", &mavros::SysStatus::errors_comm},
                                            Field{"errors_count1", &mavros::SysStatus::errors_count1},
                                            Field{"errors_count2", &mavros::SysStatus::errors_count2},
                                            Field{"errors_count3", &mavros::SysStatus::errors_count3},
                                            Field{"errors_count4", &mavros::SysStatus::errors_count4}};
};
template <>
struct Description<mavros::StatusText> {
  static constexpr std::string_view name = "mavros_msgs/msg/StatusText";
  static constexpr auto fields =
      std::tuple{Field{"header", &mavros::StatusText::header}, Field{"severity", &mavros::StatusText::severity},
                 Field{"text", &mavros::StatusText::text}};
};

}  // namespace lapwing::bus
