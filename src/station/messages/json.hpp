#pragma once

#include <string>

#include "geo/json.hpp"

/// For the .cpp files that write JSON; no header includes this one.
namespace lapwing::station {

using geo::Json;
using geo::position_json;
using geo::rounded;

/// As text on one line. Names and texts come from vehicles: bytes that are no UTF-8 are replaced.
[[nodiscard]] inline std::string dump(Json const& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lapwing::station
