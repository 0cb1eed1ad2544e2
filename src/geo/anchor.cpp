#include "geo/anchor.hpp"

#include <cmath>

namespace lapwing::geo {

std::optional<Wgs84> read_anchor(base::ConfigReader& reader) {
  constexpr double most_altitude_m = 9'000.0;
  auto const anchor = reader.numbers("anchor", 3, -most_altitude_m, most_altitude_m);
  if (!anchor) return std::nullopt;
  auto const& at = anchor->value;
  if (std::abs(at[0]) > 90.0 || std::abs(at[1]) > 180.0) {
    reader.diagnostics().report(base::config_kinds::invalid_value, anchor->span, "the anchor is no place on Earth",
                                {anchor_form});
    return std::nullopt;
  }
  return Wgs84::from_degrees(at[0], at[1], at[2]);
}

}  // namespace lapwing::geo
