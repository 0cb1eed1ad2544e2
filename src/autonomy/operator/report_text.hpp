#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "autonomy/interface/said.hpp"
#include "autonomy/interface/told.hpp"
#include "autonomy/operator/occupancy_map.hpp"
#include "base/error.hpp"

namespace lapwing::autonomy {

inline constexpr std::size_t longest_error_log = 1'000;

/// The drone's word to the operator, twice a second: one JSON object with the keys that old operators' programs know.
/// What is not known is null. `map`: with the whole map in it; without, the key is there and null. Error
/// (invalid_input): a map with other than columns times rows cells, or more than `most_map_cells`.
[[nodiscard]] base::Result<std::string> heartbeat_text(Said const& said, Told const& told,
                                                       std::optional<OccupancyMap> const& map = std::nullopt);

/// The places to park that the drone knows, all of them: `collection` is GeoJSON. Errors (invalid_input): no JSON
/// object, or more than `longest_slots` bytes.
[[nodiscard]] base::Result<std::string> slots_message(std::string_view collection);
/// With what is around them they fit into one message of the operator link, 1 MiB: some 2,000.
inline constexpr std::size_t longest_slots = 1'040'000;

/// What the operator is told in words; at most `longest_error_log` bytes of them, control characters as question marks.
[[nodiscard]] std::string error_log_text(std::string_view message);
/// Of an error, with its hint.
[[nodiscard]] std::string error_log_text(base::Error const& error);

}  // namespace lapwing::autonomy
