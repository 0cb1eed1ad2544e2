#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::autonomy {

/// How an operator's program wants the occupancy map.
enum class MapRequest : std::uint8_t {
  in_heartbeats,  ///< whole in each, as old programs know it
  as_changes,     ///< whole once, now, and then what changes, numbered
};

/// Of `{"Type":"Map","Send":"Changes"}` and `"Heartbeat"`; nothing of a text of another type, which may be a command.
/// Error (invalid_input): it asks for anything else.
[[nodiscard]] std::optional<base::Result<MapRequest>> parse_map_request(std::string_view text);

/// As an operator's program asks.
[[nodiscard]] std::string_view map_request_text(MapRequest request);

}  // namespace lapwing::autonomy
