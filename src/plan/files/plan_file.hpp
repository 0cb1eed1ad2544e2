#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "plan/plan.hpp"

/// Plans in files (docs/reference/plan-files.md has what each format can hold).
namespace lapwing::plan {

/// Larger files are refused unread; so is a KMZ whose KML is larger.
inline constexpr std::size_t max_plan_bytes = 16u << 20;
inline constexpr std::size_t max_fence_zones = 1'000;
inline constexpr std::size_t max_fence_corners = 10'000;  ///< of all zones together
/// Corners farther from home than this are a mistake, most often latitude and longitude swapped.
inline constexpr double max_fence_distance_m = 1e6;

enum class PlanFormat { qgc_plan, way_points, kml, kmz, geojson };
/// By the ending: .plan, .waypoints (also .txt), .kml, .kmz, .geojson (also .json). Errors: invalid_input.
[[nodiscard]] base::Result<PlanFormat> format_of(std::string_view file);

struct PlanReadOptions {
  /// Height above home of places for which the file says none (GeoJSON without a third number, KML that is clamped to
  /// the ground). Without it such places are refused: nobody flies at a height that was never said.
  std::optional<double> altitude_m = std::nullopt;
};

/// A plan that was drawn elsewhere.
struct PlanFile {
  Plan plan;                            ///< heights keep the frame in which they were drawn
  std::vector<std::string> notes = {};  ///< what was not read, and what was taken to be meant
};

/// Reads `text`, whatever of the formats it is in: its content decides. `file` is the name for messages and, without
/// its ending, the mission's. Errors are invalid_input and say where: "a.plan: mission.items[3].params[4]: ...",
/// "a.waypoints:7: ...", "a.kml:12: ...".
[[nodiscard]] base::Result<PlanFile> read_plan(std::string_view file, std::string_view text,
                                               PlanReadOptions const& options = {});

/// The mission of a plan, for flying: refuses one without items, or with a pattern that stores none. `file` is for the
/// message.
[[nodiscard]] base::Result<Mission> mission_to_fly(std::string_view file, Plan const& plan);

/// What of a plan a format can hold, and what is lost, each for people: "item 4: DO_SET_SERVO has no place, and a KML
/// file holds places".
struct Reduced {
  Plan plan;
  std::vector<std::string> lost;
};
[[nodiscard]] Reduced reduce(Plan const& plan, PlanFormat format);

struct WrittenPlan {
  std::string text;
  std::vector<std::string> lost;
};
/// Writes what `reduce` leaves, so that reading it gives just that (to 1e-9 degrees). Errors: invalid_input when
/// nothing is left.
[[nodiscard]] base::Result<WrittenPlan> write_plan(Plan const& plan, PlanFormat format);

/// "north.plan" -> "north"; directories are dropped too.
[[nodiscard]] std::string plan_name(std::string_view file);

}  // namespace lapwing::plan
