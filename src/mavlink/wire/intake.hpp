#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "geo/position.hpp"
#include "mavlink/codec/codec.hpp"
#include "mavlink/wire/internal/limits.hpp"
#include "mavlink/wire/wire.hpp"

namespace lapwing::mavlink::internal {

/// Lets in what can be. The one place where a vehicle's number becomes a value: the rest of the program gets nothing
/// instead of what lies outside of its range, and `told` gets the name of the field. Not a number, and the greatest
/// number of an integer, are how MAVLink says "unknown" where the dialect does not say otherwise: absent, not told.
class Intake {
 public:
  explicit Intake(std::vector<ImpossibleField>* told) : told_(told) {}

  [[nodiscard, gnu::always_inline]] std::optional<double> operator()(std::string_view field, Range const& range,
                                                                     double value) {
    if (value >= range.lowest && value <= range.highest) [[likely]]
      return value;
    note(field, range, value);
    return std::nullopt;
  }

  /// Zero: the vehicle does not know.
  [[nodiscard]] std::optional<std::chrono::microseconds> utc(std::string_view field, std::uint64_t wire) {
    if (wire == 0 || !(*this)(field, limit::utc_s, static_cast<double>(wire) * 1e-6)) return std::nullopt;
    return microseconds(wire);
  }

  using Names = std::array<std::string_view, 3>;

  /// From lat, lon in 1e-7 degrees and alt in metres: all three or none.
  [[nodiscard]] std::optional<geo::Wgs84> place(Names const& fields, std::int32_t lat, std::int32_t lon, double alt_m) {
    auto constexpr unknown = std::numeric_limits<std::int32_t>::max();
    if (lat == unknown || lon == unknown) return std::nullopt;
    auto const lat_rad = (*this)(fields[0], limit::latitude_rad, radians_e7(lat));
    auto const lon_rad = (*this)(fields[1], limit::longitude_rad, radians_e7(lon));
    auto const known_alt_m = (*this)(fields[2], limit::altitude_m, alt_m);
    if (!lat_rad || !lon_rad || !known_alt_m) return std::nullopt;
    return geo::Wgs84{*lat_rad, *lon_rad, *known_alt_m};
  }
  [[nodiscard]] std::optional<geo::Wgs84> place(Names const& fields, std::int32_t lat, std::int32_t lon,
                                                std::int32_t alt_mm) {
    auto constexpr unknown = std::numeric_limits<std::int32_t>::max();
    if (alt_mm == unknown) return std::nullopt;
    return place(fields, lat, lon, alt_mm * milli);
  }

  /// All three or none; as long as `range` allows, in whatever direction.
  [[nodiscard]] std::optional<geo::Ned> vector(Names const& fields, Range const& range, double north, double east,
                                               double down) {
    double const square = north * north + east * east + down * down;
    if (square <= range.highest * range.highest) [[likely]]
      return geo::Ned{north, east, down};
    // Each is noted that is out of range by itself.
    auto const outside = {note_outside(fields[0], range, north), note_outside(fields[1], range, east),
                          note_outside(fields[2], range, down)};
    if (std::ranges::none_of(outside, std::identity{})) note(fields[0], range, std::sqrt(square));
    return std::nullopt;
  }

  /// A rotation, which has the length 1. Zeros mean that nobody filled it in.
  [[nodiscard]] std::optional<std::array<float, 4>> rotation(std::string_view field, std::array<float, 4> const& q) {
    double square = 0.0;
    for (auto const part : q) square += static_cast<double>(part) * static_cast<double>(part);
    if (square == 0.0 || !(*this)(field, limit::quaternion_norm, square)) return std::nullopt;
    return q;
  }

 private:
  [[nodiscard]] bool note_outside(std::string_view field, Range const& range, double value) {
    if (value >= range.lowest && value <= range.highest) return false;
    note(field, range, value);
    return true;
  }
  /// Out of the way of the honest, who are nearly all.
  [[gnu::cold, gnu::noinline]] void note(std::string_view field, Range const& range, double value) {
    if (told_ && !std::isnan(value)) told_->push_back({field, value, range.unit});
  }

  std::vector<ImpossibleField>* told_;
};

}  // namespace lapwing::mavlink::internal
