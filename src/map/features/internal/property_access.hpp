#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "map/features/properties.hpp"

/// How the table of properties reaches the members of contents.
namespace lapwing::map::internal {

inline constexpr std::array<std::string_view, 3> slot_states = {"unknown", "free", "taken"};
inline constexpr std::array<std::string_view, 3> area_purposes = {"wanted", "fence", "no_go"};
/// None that browsers run.
inline constexpr std::array<std::string_view, 6> picture_media_types = {"image/jpeg", "image/png",  "image/webp",
                                                                        "image/avif", "image/tiff", "image/gif"};

template <class Member>
struct MemberOf;
template <class Owner, class Value>
struct MemberOf<Value Owner::*> {
  using Content = Owner;
};

/// The member of whatever the content is; the table of a layer is only used for that layer's contents.
template <auto field>
auto& member(auto& content) {
  return std::get<typename MemberOf<decltype(field)>::Content>(content).*field;
}

[[nodiscard]] inline std::unexpected<base::Error> takes(std::string_view what) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("takes {}", what));
}

/// Nothing for nothing. A whole number is a real one, too, and the other way round: files do not tell them apart.
[[nodiscard]] inline base::Result<std::optional<double>> real_of(PropertyValue const& value) {
  if (std::holds_alternative<std::monostate>(value)) return std::nullopt;
  if (auto const* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  auto const* number = std::get_if<double>(&value);
  if (!number || !std::isfinite(*number)) return takes("a number");
  return *number;
}

[[nodiscard]] inline base::Result<std::optional<std::int64_t>> integer_of(PropertyValue const& value) {
  constexpr double most = 1e15;
  if (auto const* whole = std::get_if<std::int64_t>(&value)) return *whole;
  auto const number = real_of(value);
  if (!number) return std::unexpected(number.error());
  if (!*number) return std::nullopt;
  if (std::abs(**number) > most || std::trunc(**number) != **number) return takes("a whole number");
  return static_cast<std::int64_t>(**number);
}

[[nodiscard]] inline base::Result<std::optional<base::UtcTime>> time_of(PropertyValue const& value) {
  if (std::holds_alternative<std::monostate>(value)) return std::nullopt;
  if (auto const* time = std::get_if<base::UtcTime>(&value)) return *time;
  return takes("a time");
}

template <auto field>
PropertyValue get_text(Content const& content) {
  auto const& text = member<field>(content);
  return text.empty() ? PropertyValue() : PropertyValue(text);
}
template <auto field>
base::Result<> set_text(Content& content, PropertyValue const& value) {
  auto const* text = std::get_if<std::string>(&value);
  if (!text && !std::holds_alternative<std::monostate>(value)) return takes("text");
  member<field>(content) = text ? *text : std::string();
  return {};
}

using Words = std::span<std::string_view const>;

[[nodiscard]] inline PropertyValue word_at(Words words, auto word) {
  return std::string(words[static_cast<std::size_t>(word)]);
}
/// Which of the words it is; the first for nothing.
[[nodiscard]] inline base::Result<std::size_t> word_in(Words words, PropertyValue const& value) {
  if (std::holds_alternative<std::monostate>(value)) return 0U;
  auto const* text = std::get_if<std::string>(&value);
  auto const found = text ? std::ranges::find(words, *text) : words.end();
  if (found == words.end()) return takes(fmt::format("one of the words {}", fmt::join(words, ", ")));
  return static_cast<std::size_t>(found - words.begin());
}

template <auto field, auto const& words>
PropertyValue get_word(Content const& content) {
  return word_at(words, member<field>(content));
}
template <auto field, auto const& words>
base::Result<> set_word(Content& content, PropertyValue const& value) {
  auto const index = word_in(words, value);
  if (!index) return std::unexpected(index.error());
  auto& word = member<field>(content);
  word = static_cast<std::remove_reference_t<decltype(word)>>(*index);
  return {};
}

template <auto field>
PropertyValue get_real(Content const& content) {
  return member<field>(content);
}
template <auto field>
base::Result<> set_real(Content& content, PropertyValue const& value) {
  auto const number = real_of(value);
  if (!number) return std::unexpected(number.error());
  member<field>(content) = number->value_or(0.0);
  return {};
}

template <auto field>
PropertyValue get_integer(Content const& content) {
  return std::int64_t{member<field>(content)};
}
template <auto field>
base::Result<> set_integer(Content& content, PropertyValue const& value) {
  auto const number = integer_of(value);
  if (!number) return std::unexpected(number.error());
  auto const whole = number->value_or(0);
  if (whole < std::numeric_limits<int>::min() || whole > std::numeric_limits<int>::max())
    return takes("a smaller number");
  member<field>(content) = static_cast<int>(whole);
  return {};
}

template <auto field>
PropertyValue get_time(Content const& content) {
  auto const time = member<field>(content);
  return time == base::UtcTime() ? PropertyValue() : PropertyValue(time);
}
template <auto field>
base::Result<> set_time(Content& content, PropertyValue const& value) {
  auto const time = time_of(value);
  if (!time) return std::unexpected(time.error());
  member<field>(content) = time->value_or(base::UtcTime());
  return {};
}

/// A real number or a time that may be missing.
template <auto field>
PropertyValue get_optional(Content const& content) {
  auto const& value = member<field>(content);
  return value ? PropertyValue(*value) : PropertyValue();
}
template <auto field>
base::Result<> set_optional(Content& content, PropertyValue const& value) {
  auto& target = member<field>(content);
  auto const read = [&] {
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(target)>, std::optional<double>>)
      return real_of(value);
    else
      return time_of(value);
  }();
  if (!read) return std::unexpected(read.error());
  target = *read;
  return {};
}

/// One number of several that are there together or not at all. They are set one after the other, so meanwhile those
/// that are still missing are no numbers; `feature_fault` finds what remains so.
inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

template <int row, int column>
PropertyValue get_covariance(Content const& content) {
  auto const& covariance = std::get<PointOfInterest>(content).covariance_m2;
  if (!covariance || std::isnan((*covariance)(row, column))) return {};
  return (*covariance)(row, column);
}
template <int row, int column>
base::Result<> set_covariance(Content& content, PropertyValue const& value) {
  auto const number = real_of(value);
  if (!number) return std::unexpected(number.error());
  auto& covariance = std::get<PointOfInterest>(content).covariance_m2;
  if (!covariance) covariance = Eigen::Matrix2d::Constant(missing);
  (*covariance)(row, column) = (*covariance)(column, row) = number->value_or(missing);
  if (covariance->array().isNaN().all()) covariance.reset();
  return {};
}

template <int axis>
PropertyValue get_quaternion(Content const& content) {
  auto const& rotation = std::get<Picture>(content).site_from_camera;
  if (!rotation || std::isnan(rotation->coeffs()[axis])) return {};
  return rotation->coeffs()[axis];
}
template <int axis>
base::Result<> set_quaternion(Content& content, PropertyValue const& value) {
  auto const number = real_of(value);
  if (!number) return std::unexpected(number.error());
  auto& rotation = std::get<Picture>(content).site_from_camera;
  if (!rotation) rotation = Eigen::Quaterniond(missing, missing, missing, missing);
  rotation->coeffs()[axis] = number->value_or(missing);
  if (rotation->coeffs().array().isNaN().all()) rotation.reset();
  return {};
}

/// Where the picture was taken from. A point tells that itself.
template <int axis>
PropertyValue get_camera(Content const& content) {
  auto const& picture = std::get<Picture>(content);
  return picture.footprint.empty() ? PropertyValue() : PropertyValue(picture.position.v[axis]);
}
template <int axis>
base::Result<> set_camera(Content& content, PropertyValue const& value) {
  auto const number = real_of(value);
  if (!number) return std::unexpected(number.error());
  auto& picture = std::get<Picture>(content);
  if (picture.footprint.empty())
    return *number ? base::Result<>(takes("nothing where the geometry is the place of the camera itself"))
                   : base::Result<>();
  picture.position.v[axis] = number->value_or(0.0);
  return {};
}

}  // namespace lapwing::map::internal
