#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include <minimal/minimal.hpp>  // the generated dialect's base; each codec_*.cpp adds the messages that it converts

#include "base/text/printable.hpp"
#include "geo/position.hpp"
#include "mavlink/wire/frame.hpp"

/// What the codec_*.cpp share: between frames and the dialect's structs, and between wire units and SI.
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
[[nodiscard]] std::optional<double> unless(T unknown, T wire, double scale) {
  if (wire == unknown) return std::nullopt;
  return static_cast<double>(wire) * scale;
}
template <class T>
[[nodiscard]] T rounded_or(T unknown, std::optional<double> value, double scale) {
  return value ? rounded<T>(*value / scale) : unknown;
}

inline constexpr double degree = std::numbers::pi / 180.0;
inline constexpr double centi = 0.01;
inline constexpr double milli = 0.001;

[[nodiscard]] inline double radians_e7(std::int32_t wire) {
  return static_cast<double>(wire) * 1e-7 * degree;
}
[[nodiscard]] inline std::int32_t degrees_e7(double angle_rad) {
  return rounded<std::int32_t>(angle_rad / degree * 1e7);
}

inline constexpr std::int32_t unknown32 = std::numeric_limits<std::int32_t>::max();

/// Writes a place as lat and lon in 1e-7 degrees and alt in mm.
inline void put_place(std::optional<geo::Wgs84> const& place, std::int32_t& lat, std::int32_t& lon,
                      std::int32_t& alt_mm) {
  lat = place ? degrees_e7(place->lat_rad) : unknown32;
  lon = place ? degrees_e7(place->lon_rad) : unknown32;
  alt_mm = place ? rounded<std::int32_t>(place->alt_m / milli) : unknown32;
}

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
/// Three floats of a vector; NaN for the unknown.
inline void put_vector(std::optional<geo::Ned> const& vector, float& north, float& east, float& down) {
  north = vector ? narrow(vector->north) : not_a_number;
  east = vector ? narrow(vector->east) : not_a_number;
  down = vector ? narrow(vector->down) : not_a_number;
}

[[nodiscard]] inline base::Duration since_boot(std::uint32_t ms) {
  return std::chrono::milliseconds(ms);
}
[[nodiscard]] inline std::uint32_t boot_ms(base::Duration since_boot) {
  return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::milliseconds>(since_boot).count());
}
[[nodiscard]] inline std::chrono::microseconds microseconds(std::uint64_t wire) {
  return std::chrono::microseconds(static_cast<std::int64_t>(wire));
}
[[nodiscard]] inline std::uint64_t microsecond_count(std::chrono::microseconds time) {
  return static_cast<std::uint64_t>(time.count());
}

/// Texts end at the first NUL, or fill their field. What a terminal or a file would take for more than text is not let
/// in.
template <std::size_t size>
[[nodiscard]] std::string text(std::array<char, size> const& field) {
  return base::printable({field.data(), strnlen(field.data(), size)});
}
template <std::size_t size>
[[nodiscard]] std::array<char, size> text_field(std::string_view value) {
  std::array<char, size> field{};
  std::copy_n(value.data(), std::min(size, value.size()), field.data());
  return field;
}

template <class Wire>
void put_target(Wire& wire, Address target) {
  wire.target_system = target.system;
  wire.target_component = target.component;
}
template <class Wire>
[[nodiscard]] Address target(Wire const& wire) {
  return {wire.target_system, wire.target_component};
}

/// The first four, which commands and mission items have in common.
template <class Wire, class Params>
void put_params(Wire& wire, Params const& params) {
  wire.param1 = params[0];
  wire.param2 = params[1];
  wire.param3 = params[2];
  wire.param4 = params[3];
}

}  // namespace lapwing::mavlink::internal
