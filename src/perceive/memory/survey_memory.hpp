#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "explore/lot/lot_sight.hpp"
#include "geo/site.hpp"
#include "map/features/feature.hpp"

namespace lapwing::perceive {

/// What a process that was started anew takes up of the one before it. Slots lie in the site's frame as they were on
/// the map; the ground that was seen is what the sights show.
struct SurveyMemory {
  base::UtcTime at = {};                    ///< when it was written
  int lives = 1;                            ///< processes that have had this map, one after the other
  std::optional<base::UtcTime> begun = {};  ///< when the drone began to explore
  bool explores = false;                    ///< and whether it did when this was written
  std::string ending = {};                  ///< why the survey was over; empty: it was not
  std::size_t pictures = 0;                 ///< that showed some of the area
  std::vector<map::Feature> slots = {};
  std::vector<explore::LotSight> sights = {};  ///< in the order in which they were added
};

/// JSON Lines: what holds for all, the slots as GeoJSON, then the sights, which `sight_lines` has as `KeptSights` does;
/// the last line is the CRC-32 of all before it. `memory.sights` is not written.
[[nodiscard]] std::string memory_text(SurveyMemory const& memory, geo::Site const& site, std::string_view sight_lines);

/// The last line put behind what it is the checksum of.
[[nodiscard]] std::string with_checksum(std::string content);

/// Into the frame of `site`, which may have another anchor than when it was written: a flight controller has another
/// origin after each start. Errors, invalid_input: too long, cut off or changed, of another program or a later version,
/// of a place more than 2 km away, or with something in it that makes no sense.
[[nodiscard]] base::Result<SurveyMemory> read_memory(std::string_view text, geo::Site const& site);

/// Longer texts are not read.
inline constexpr std::size_t longest_memory = std::size_t{48} * 1024 * 1024;

}  // namespace lapwing::perceive
