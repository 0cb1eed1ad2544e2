#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bus/messages/common.hpp"

/// diagnostic_msgs: what a process says of its own health.
namespace lapwing::bus {

struct KeyValue {
  std::string key = {};
  std::string value = {};
  friend bool operator==(KeyValue const&, KeyValue const&) = default;
};
template <>
struct Description<KeyValue> {
  static constexpr std::string_view name = "diagnostic_msgs/msg/KeyValue";
  static constexpr auto fields = std::tuple{Field{"key", &KeyValue::key}, Field{"value", &KeyValue::value}};
};

struct DiagnosticStatus {
  static constexpr std::uint8_t ok = 0;
  static constexpr std::uint8_t warn = 1;
  static constexpr std::uint8_t error = 2;
  static constexpr std::uint8_t stale = 3;
  std::uint8_t level = ok;
  std::string name = {};
  std::string message = {};
  std::string hardware_id = {};
  std::vector<KeyValue> values = {};
  friend bool operator==(DiagnosticStatus const&, DiagnosticStatus const&) = default;
};
template <>
struct Description<DiagnosticStatus> {
  static constexpr std::string_view name = "diagnostic_msgs/msg/DiagnosticStatus";
  static constexpr auto fields =
      std::tuple{Field{"level", &DiagnosticStatus::level}, Field{"name", &DiagnosticStatus::name},
                 Field{"message", &DiagnosticStatus::message}, Field{"hardware_id", &DiagnosticStatus::hardware_id},
                 Field{"values", &DiagnosticStatus::values}};
};

}  // namespace lapwing::bus
