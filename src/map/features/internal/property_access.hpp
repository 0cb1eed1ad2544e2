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
template <auto Member>
auto& member(auto& content) {
  return std::get<typename MemberOf<decltype(Member)>::Content>(content).*Member;
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

template <auto Member>
PropertyValue get_text(Content const& content) {
  auto const& text = member<Member>(content);
  return text.empty() ? PropertyValue() : PropertyValue(text);
}
template <auto Member>
base::Result<> set_text(Content& content, PropertyValue const& value) {
  auto const* text = std::get_if<std::string>(&value);
  if (!text && !std::holds_alternative<std::monostate>(value)) return takes("text");
  member<Member>(content) = text ? *text : std::string();
  return {};
}

template <auto Member, auto const& Words>
PropertyValue get_word(Content const& content) {
  return std::string(Words[static_cast<std::size_t>(member<Member>(content))]);
}
template <auto Member, auto const& Words>
base::Result<> set_word(Content& content, PropertyValue const& value) {
  auto& word = member<Member>(content);
  using Word = std::remove_reference_t<decltype(word)>;
  if (std::holds_alternative<std::monostate>(value)) {
    word = Word();
    return {};
  }
  auto const* text = std::get_if<std::string>(&value);
  auto const found = text ? std::ranges::find(Words, *text) : Words.end();
  if (found == Words.end()) return takes(fmt::format("one of the words {}", fmt::join(Words, ", ")));
  word = static_cast<Word>(found - Words.begin());
  return {};
}

template <auto Member>
PropertyValue get_real(Content const& content) {
  return member<Member>(content);
}
template <auto Member>
base::Result<> set_real(Content& content, PropertyValue const& value) {
  auto const number = real_of(value);
  if (!number) return std::unexpected(number.error());
  member<Member>(content) = number->value_or(0.0);
  return {};
}

template <auto Member>
PropertyValue get_integer(Content const& content) {
  return std::int64_t{member<Member>(content)};
}
template <auto Member>
base::Result<> set_integer(Content& content, PropertyValue const& value) {
  auto const number = integer_of(value);
  if (!number) return std::unexpected(number.error());
  auto const whole = number->value_or(0);
  if (whole < std::numeric_limits<int>::min() || whole > std::numeric_limits<int>::max())
    return takes("a smaller number");
  member<Member>(content) = static_cast<int>(whole);
  return {};
}

template <auto Member>
PropertyValue get_time(Content const& content) {
  auto const time = member<Member>(content);
  return time == base::UtcTime() ? PropertyValue() : PropertyValue(time);
}
template <auto Member>
base::Result<> set_time(Content& content, PropertyValue const& value) {
  auto const time = time_of(value);
  if (!time) return std::unexpected(time.error());
  member<Member>(content) = time->value_or(base::UtcTime());
  return {};
}

/// A real number or a time that may be missing.
template <auto Member>
PropertyValue get_optional(Content const& content) {
  auto const& value = member<Member>(content);
  return value ? PropertyValue(*value) : PropertyValue();
}
template <auto Member>
base::Result<> set_optional(Content& content, PropertyValue const& value) {
  auto& target = member<Member>(content);
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

template <int Row, int Column>
PropertyValue get_covariance(Content const& content) {
  auto const& covariance = std::get<PointOfInterest>(content).covariance_m2;
  if (!covariance || std::isnan((*covariance)(Row, Column))) return {};
  return (*covariance)(Row, Column);
}
template <int Row, int Column>
base::Result<> set_covariance(Content& content, PropertyValue const& value) {
  auto const number = real_of(value);
  if (!number) return std::unexpected(number.error());
  auto& covariance = std::get<PointOfInterest>(content).covariance_m2;
  if (!covariance) covariance = Eigen::Matrix2d::Constant(missing);
  (*covariance)(Row, Column) = (*covariance)(Column, Row) = number->value_or(missing);
  if (covariance->array().isNaN().all()) covariance.reset();
  return {};
}

template <int Axis>
PropertyValue get_quaternion(Content const& content) {
  auto const& rotation = std::get<Picture>(content).site_from_camera;
  if (!rotation || std::isnan(rotation->coeffs()[Axis])) return {};
  return rotation->coeffs()[Axis];
}
template <int Axis>
base::Result<> set_quaternion(Content& content, PropertyValue const& value) {
  auto const number = real_of(value);
  if (!number) return std::unexpected(number.error());
  auto& rotation = std::get<Picture>(content).site_from_camera;
  if (!rotation) rotation = Eigen::Quaterniond(missing, missing, missing, missing);
  rotation->coeffs()[Axis] = number->value_or(missing);
  if (rotation->coeffs().array().isNaN().all()) rotation.reset();
  return {};
}

/// Where the picture was taken from. A point tells that itself.
template <int Axis>
PropertyValue get_camera(Content const& content) {
  auto const& picture = std::get<Picture>(content);
  return picture.footprint.empty() ? PropertyValue() : PropertyValue(picture.position.v[Axis]);
}
template <int Axis>
base::Result<> set_camera(Content& content, PropertyValue const& value) {
  auto const number = real_of(value);
  if (!number) return std::unexpected(number.error());
  auto& picture = std::get<Picture>(content);
  if (picture.footprint.empty())
    return *number ? base::Result<>(takes("nothing where the geometry is the place of the camera itself"))
                   : base::Result<>();
  picture.position.v[Axis] = number->value_or(0.0);
  return {};
}

}  // namespace lapwing::map::internal
