#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>

#include <minimal/minimal.hpp>  // the generated dialect's base; each fields_*.hpp adds the messages that it describes

#include "geo/position.hpp"
#include "mavlink/wire/frame.hpp"

/// What the codec is made of: between frames and the dialect's structs, and between wire units and SI.
namespace lapwing::mavlink::internal {

template <class Wire>
[[nodiscard]] Wire unpack(Frame const& frame) {
  ::mavlink::mavlink_message_t raw;
  raw.len = Wire::LENGTH;
  std::memcpy(raw.payload64, frame.payload.data(), Wire::LENGTH);
  ::mavlink::MsgMap map(static_cast<::mavlink::mavlink_message_t const*>(&raw));
  Wire wire;
  wire.deserialize(map);
  return wire;
}

template <class Wire>
void pack(Wire const& wire, Frame& frame) {
  ::mavlink::mavlink_message_t raw;
  ::mavlink::MsgMap map(raw);
  wire.serialize(map);
  std::memcpy(frame.payload.data(), raw.payload64, Wire::LENGTH);
  frame.message_id = Wire::MSG_ID;
  frame.payload_size = Wire::LENGTH;
}

/// The nearest value that T holds; 0 for NaN.
template <class T>
[[nodiscard]] T rounded(double value) {
  if (std::isnan(value)) return T{0};
  auto constexpr lowest = static_cast<double>(std::numeric_limits<T>::lowest());
  auto constexpr highest = static_cast<double>(std::numeric_limits<T>::max());
  return static_cast<T>(std::llround(std::clamp(value, lowest, highest)));
}

template <class T>
[[nodiscard]] T rounded_or(T unknown, std::optional<double> value, double scale) {
  return value ? rounded<T>(*value / scale) : unknown;
}

inline constexpr double degree = std::numbers::pi / 180.0;
inline constexpr double centi = 0.01;
inline constexpr double milli = 0.001;
inline constexpr double centidegree = degree * centi;

[[nodiscard]] inline double radians_e7(std::int32_t wire) {
  return static_cast<double>(wire) * 1e-7 * degree;
}
[[nodiscard]] inline std::int32_t degrees_e7(double angle_rad) {
  return rounded<std::int32_t>(angle_rad / degree * 1e7);
}

inline constexpr std::uint16_t unknown16 = std::numeric_limits<std::uint16_t>::max();
inline constexpr std::int32_t unknown32 = std::numeric_limits<std::int32_t>::max();

/// A heading in `unit` (radians), as an unsigned number below the full circle.
template <class T>
[[nodiscard]] T heading(double angle_rad, double unit) {
  auto const full = std::llround(2.0 * std::numbers::pi / unit);
  return static_cast<T>(std::llround(geo::wrap_two_pi(angle_rad) / unit) % full);
}

inline constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

[[nodiscard]] inline float narrow(double value) {
  return static_cast<float>(value);
}
/// In `unit`; NaN for the unknown.
[[nodiscard]] inline float narrow(std::optional<double> value, double unit = 1.0) {
  return value ? static_cast<float>(*value / unit) : not_a_number;
}
[[nodiscard]] inline std::chrono::microseconds microseconds(std::uint64_t wire) {
  return std::chrono::microseconds(static_cast<std::int64_t>(wire));
}
}  // namespace lapwing::mavlink::internal
