#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "autonomy/operator/occupancy_map.hpp"
#include "base/error.hpp"
#include "geo/position.hpp"
#include "vehicle/slot_counts.hpp"

namespace lapwing::autonomy {

/// A drone's messages as an operator's program reads them (`report_text.hpp` writes them).
namespace report {

struct Heartbeat {
  std::string state = {};
  std::string mode = {};  ///< empty: the drone does not know
  std::optional<double> height_m = {};
  bool is_armed = false;
  std::optional<geo::Wgs84> position = {};  ///< at height 0
  std::optional<geo::Point<ArmingFrame>> local = {};
  std::optional<double> battery = {};  ///< 0..1
  std::string user_error = {};         ///< "No_Lot_Detected"; empty for none
  bool is_healthy = true;
  std::string health_reason = {};
  std::optional<OccupancyMap> map = {};  ///< nothing where the heartbeat carries none
};

struct ErrorLog {
  std::string message;
};

/// How far the drone's survey is.
struct Survey {
  double coverage = 0.0;    ///< 0..1, of the area
  std::string begun = {};   ///< when it began to explore, the last time, as the drone writes times; empty: never
  bool is_over = false;     ///< there is nothing more to explore
  std::string ending = {};  ///< why, in words
  std::optional<vehicle::SlotCounts> slots = {};
  friend bool operator==(Survey const&, Survey const&) = default;
};

/// All places to park that the drone knows: features of the layer `slots`.
struct Slots {
  std::string features;               ///< a GeoJSON FeatureCollection
  std::optional<Survey> survey = {};  ///< nothing where the drone does not tell
};

/// The whole occupancy map, for who has asked for it and its changes.
struct Map {
  std::uint64_t revision = 0;  ///< from 1 on
  OccupancyMap map;
};

/// What is another one in the map `revision` than in the map `since`.
struct MapChanges {
  struct Run {
    std::uint32_t first = 0;  ///< the number of the first cell
    std::vector<std::int8_t> cells;
  };
  std::uint64_t revision = 0;
  std::uint64_t since = 0;
  std::vector<Run> runs;
};

}  // namespace report

using Report = std::variant<report::Heartbeat, report::ErrorLog, report::Slots, report::Map, report::MapChanges>;

/// Longer texts of one member are cut.
inline constexpr std::size_t longest_report_text = 1'000;

/// Of one JSON object, of which `Type` decides. Numbers that are out of their range are as if they were not there.
/// Errors (invalid_input): no JSON, no object, an unknown type, a map whose cells are not as many as it says or not
/// from -1 to 100, a map or changes without their numbers, changes beyond what a map may have.
[[nodiscard]] base::Result<Report> parse_report(std::string_view text);

}  // namespace lapwing::autonomy
