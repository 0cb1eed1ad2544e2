#pragma once

#include <string>

#include "base/text/json.hpp"
#include "geo/position_json.hpp"

/// For the .cpp files that write JSON; no header includes this one.
namespace lapwing::station {

using geo::Json;
using geo::position_json;
using geo::rounded;

/// As text on one line.
[[nodiscard]] inline std::string dump(Json const& json) {
  return base::to_text(json);
}

}  // namespace lapwing::station
