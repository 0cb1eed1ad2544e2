#pragma once

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "geo/position.hpp"

/// For the .cpp files that write JSON; no header includes this one.
namespace lapwing::station {

using Json = nlohmann::ordered_json;

/// As text on one line. Names and texts come from vehicles: bytes that are no UTF-8 are replaced.
[[nodiscard]] inline std::string dump(Json const& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// With so many decimals: full precision would double the traffic and mean nothing. A value that is no number becomes
/// null.
[[nodiscard]] inline Json rounded(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  double const scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

/// 1e-7 degrees is what autopilots send, about a centimetre.
[[nodiscard]] inline Json position_json(geo::Wgs84 const& place) {
  return {{"lat_deg", rounded(place.lat_deg(), 7)},
          {"lon_deg", rounded(place.lon_deg(), 7)},
          {"alt_m", rounded(place.alt_m, 2)}};
}

}  // namespace lapwing::station
