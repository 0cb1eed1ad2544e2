#pragma once

#include <cstdint>
#include <optional>

#include "autonomy/operator/report_reader.hpp"

namespace lapwing::autonomy {

/// A drone's occupancy map as an operator's program puts it together, of the whole one and the changes that follow.
class MapFollower {
 public:
  enum class Outcome : std::uint8_t {
    shown,   ///< `map` is what the drone has
    missed,  ///< something before it is missing: ask for the whole map again
    waits,   ///< so it was already: nothing is known until a whole map comes
  };

  Outcome take(report::Map whole);
  Outcome take(report::MapChanges const& changes);

  /// Nothing before the first whole one; an old one while something is missing.
  [[nodiscard]] std::optional<OccupancyMap> const& map() const { return map_; }

 private:
  std::optional<OccupancyMap> map_;
  std::uint64_t revision_ = 0;  ///< 0: none that changes could follow
};

}  // namespace lapwing::autonomy
