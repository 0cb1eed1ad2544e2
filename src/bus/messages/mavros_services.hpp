#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus/messages/common.hpp"

/// The services of MAVROS.
namespace lapwing::bus {

/// rcl_interfaces: of one of several types.
struct ParameterValue {
  static constexpr std::uint8_t not_set = 0;
  static constexpr std::uint8_t boolean = 1;
  static constexpr std::uint8_t integer = 2;
  static constexpr std::uint8_t real = 3;
  std::uint8_t type = not_set;
  bool bool_value = false;
  std::int64_t integer_value = 0;
  double double_value = 0.0;
  std::string string_value = {};
  std::vector<std::uint8_t> byte_array_value = {};
  std::vector<std::uint8_t> bool_array_value = {};  ///< a byte each on the wire
  std::vector<std::int64_t> integer_array_value = {};
  std::vector<double> double_array_value = {};
  std::vector<std::string> string_array_value = {};
  friend bool operator==(ParameterValue const&, ParameterValue const&) = default;
};

namespace mavros {

/// cmd/arming: arms or disarms.
struct CommandBool {
  static constexpr std::string_view name = "mavros_msgs/srv/CommandBool";
  struct Request {
    bool value = false;
    friend bool operator==(Request const&, Request const&) = default;
  };
  struct Response {
    bool success = false;
    std::uint8_t result = 0;  ///< MAV_RESULT
    friend bool operator==(Response const&, Response const&) = default;
  };
};

/// cmd/takeoff.
struct CommandTOL {
  static constexpr std::string_view name = "mavros_msgs/srv/CommandTOL";
  struct Request {
    float min_pitch = 0.0F;
    float yaw = 0.0F;       ///< degrees, clockwise from north
    float latitude = 0.0F;  ///< degrees
    float longitude = 0.0F;
    float altitude = 0.0F;  ///< metres
    friend bool operator==(Request const&, Request const&) = default;
  };
  struct Response {
    bool success = false;
    std::uint8_t result = 0;  ///< MAV_RESULT
    friend bool operator==(Response const&, Response const&) = default;
  };
};

/// cmd/command: any MAVLink command, in its own units.
struct CommandLong {
  static constexpr std::string_view name = "mavros_msgs/srv/CommandLong";
  struct Request {
    bool broadcast = false;
    std::uint16_t command = 0;  ///< MAV_CMD
    std::uint8_t confirmation = 0;
    float param1 = 0.0F;
    float param2 = 0.0F;
    float param3 = 0.0F;
    float param4 = 0.0F;
    float param5 = 0.0F;
    float param6 = 0.0F;
    float param7 = 0.0F;
    friend bool operator==(Request const&, Request const&) = default;
  };
  struct Response {
    bool success = false;
    std::uint8_t result = 0;  ///< MAV_RESULT
    friend bool operator==(Response const&, Response const&) = default;
  };
};

/// set_mode.
struct SetMode {
  static constexpr std::string_view name = "mavros_msgs/srv/SetMode";
  struct Request {
    std::uint8_t base_mode = 0;    ///< 0: the mode is `custom_mode`
    std::string custom_mode = {};  ///< as the autopilot names it
    friend bool operator==(Request const&, Request const&) = default;
  };
  struct Response {
    bool mode_sent = false;
    friend bool operator==(Response const&, Response const&) = default;
  };
};

/// param/set.
struct ParamSetV2 {
  static constexpr std::string_view name = "mavros_msgs/srv/ParamSetV2";
  struct Request {
    bool force_set = false;
    std::string param_id = {};
    ParameterValue value = {};
    friend bool operator==(Request const&, Request const&) = default;
  };
  struct Response {
    bool success = false;
    ParameterValue value = {};  ///< that it has now
    friend bool operator==(Response const&, Response const&) = default;
  };
};

}  // namespace mavros

template <>
struct Description<ParameterValue> {
  static constexpr std::string_view name = "rcl_interfaces/msg/ParameterValue";
  static constexpr auto fields = std::tuple{Field{"type", &ParameterValue::type},
                                            Field{"bool_value", &ParameterValue::bool_value},
                                            Field{"integer_value", &ParameterValue::integer_value},
                                            Field{"double_value", &ParameterValue::double_value},
                                            Field{"string_value", &ParameterValue::string_value},
                                            Field{"byte_array_value", &ParameterValue::byte_array_value},
                                            Field{"bool_array_value", &ParameterValue::bool_array_value},
                                            Field{"integer_array_value", &ParameterValue::integer_array_value},
                                            Field{"double_array_value", &ParameterValue::double_array_value},
                                            Field{"string_array_value", &ParameterValue::string_array_value}};
};
template <>
struct Description<mavros::CommandBool::Request> {
  static constexpr std::string_view name = "mavros_msgs/srv/CommandBool_Request";
  static constexpr auto fields = std::tuple{Field{"value", &mavros::CommandBool::Request::value}};
};
template <>
struct Description<mavros::CommandBool::Response> {
  static constexpr std::string_view name = "mavros_msgs/srv/CommandBool_Response";
  static constexpr auto fields = std::tuple{Field{"success", &mavros::CommandBool::Response::success},
                                            Field{"result", &mavros::CommandBool::Response::result}};
};
template <>
struct Description<mavros::CommandTOL::Request> {
  static constexpr std::string_view name = "mavros_msgs/srv/CommandTOL_Request";
  static constexpr auto fields = std::tuple{Field{"min_pitch", &mavros::CommandTOL::Request::min_pitch},
                                            Field{"yaw", &mavros::CommandTOL::Request::yaw},
                                            Field{"latitude", &mavros::CommandTOL::Request::latitude},
                                            Field{"longitude", &mavros::CommandTOL::Request::longitude},
                                            Field{"altitude", &mavros::CommandTOL::Request::altitude}};
};
template <>
struct Description<mavros::CommandTOL::Response> {
  static constexpr std::string_view name = "mavros_msgs/srv/CommandTOL_Response";
  static constexpr auto fields = std::tuple{Field{"success", &mavros::CommandTOL::Response::success},
                                            Field{"result", &mavros::CommandTOL::Response::result}};
};
template <>
struct Description<mavros::CommandLong::Request> {
  static constexpr std::string_view name = "mavros_msgs/srv/CommandLong_Request";
  static constexpr auto fields = std::tuple{Field{"broadcast", &mavros::CommandLong::Request::broadcast},
                                            Field{"command", &mavros::CommandLong::Request::command},
                                            Field{"confirmation", &mavros::CommandLong::Request::confirmation},
                                            Field{"param1", &mavros::CommandLong::Request::param1},
                                            Field{"param2", &mavros::CommandLong::Request::param2},
                                            Field{"param3", &mavros::CommandLong::Request::param3},
                                            Field{"param4", &mavros::CommandLong::Request::param4},
                                            Field{"param5", &mavros::CommandLong::Request::param5},
                                            Field{"param6", &mavros::CommandLong::Request::param6},
                                            Field{"param7", &mavros::CommandLong::Request::param7}};
};
template <>
struct Description<mavros::CommandLong::Response> {
  static constexpr std::string_view name = "mavros_msgs/srv/CommandLong_Response";
  static constexpr auto fields = std::tuple{Field{"success", &mavros::CommandLong::Response::success},
                                            Field{"result", &mavros::CommandLong::Response::result}};
};
template <>
struct Description<mavros::SetMode::Request> {
  static constexpr std::string_view name = "mavros_msgs/srv/SetMode_Request";
  static constexpr auto fields = std::tuple{Field{"base_mode", &mavros::SetMode::Request::base_mode},
                                            Field{"custom_mode", &mavros::SetMode::Request::custom_mode}};
};
template <>
struct Description<mavros::SetMode::Response> {
  static constexpr std::string_view name = "mavros_msgs/srv/SetMode_Response";
  static constexpr auto fields = std::tuple{Field{"mode_sent", &mavros::SetMode::Response::mode_sent}};
};
template <>
struct Description<mavros::ParamSetV2::Request> {
  static constexpr std::string_view name = "mavros_msgs/srv/ParamSetV2_Request";
  static constexpr auto fields = std::tuple{Field{"force_set", &mavros::ParamSetV2::Request::force_set},
                                            Field{"param_id", &mavros::ParamSetV2::Request::param_id},
                                            Field{"value", &mavros::ParamSetV2::Request::value}};
};
template <>
struct Description<mavros::ParamSetV2::Response> {
  static constexpr std::string_view name = "mavros_msgs/srv/ParamSetV2_Response";
  static constexpr auto fields = std::tuple{Field{"success", &mavros::ParamSetV2::Response::success},
                                            Field{"value", &mavros::ParamSetV2::Response::value}};
};

}  // namespace lapwing::bus
