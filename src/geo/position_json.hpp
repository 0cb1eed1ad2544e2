#pragma once

#include <cmath>

#include <nlohmann/json.hpp>

#include "geo/position.hpp"

/// How places and measures are written as JSON. For the .cpp files that do; no header includes this one.
namespace lapwing::geo {

using Json = nlohmann::ordered_json;

/// With so many decimals: full precision would double what is written and mean nothing. A value that is no number
/// becomes null.
[[nodiscard]] inline Json rounded(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  double const scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale + 0.0;  // no negative zero
}

/// 1e-7 degrees is what autopilots send, about a centimetre.
[[nodiscard]] inline Json position_json(Wgs84 const& place) {
  return {{"lat_deg", rounded(place.lat_deg(), 7)},
          {"lon_deg", rounded(place.lon_deg(), 7)},
          {"alt_m", rounded(place.alt_m, 2)}};
}

}  // namespace lapwing::geo
