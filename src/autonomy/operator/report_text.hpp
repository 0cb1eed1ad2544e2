#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "autonomy/interface/said.hpp"
#include "autonomy/interface/told.hpp"
#include "base/error.hpp"

namespace lapwing::autonomy {

/// The occupancy map as ROS has it (nav_msgs/OccupancyGrid): row by row from the lower left corner, -1 unknown, else
/// percent.
struct OccupancyMap {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  double resolution_m = 0.0;
  geo::Point<ArmingFrame> origin = {};  ///< of the lower left corner
  std::vector<std::int8_t> cells = {};
};

/// As large as one message of the operator link carries with every cell at its longest.
inline constexpr std::size_t most_map_cells = 200'000;
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
