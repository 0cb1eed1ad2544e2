#pragma once

#include <optional>
#include <vector>

#include "dryrun/flight_record.hpp"
#include "plan/fence.hpp"

namespace lapwing::dryrun {

/// Over some time of one vehicle.
struct Figures {
  double path_m = 0.0;
  double highest_m = 0.0;     ///< above the ground of the site
  double battery_used = 0.0;  ///< share of a full one
  double energy_wh = 0.0;
};
[[nodiscard]] Figures figures(VehicleRecord const& vehicle, base::Duration begin, base::Duration end);

/// Two vehicles, by their places in the record.
struct Pair {
  std::size_t first = 0;
  std::size_t second = 0;
  plan::Approach approach;
};

struct VehicleBreach {
  std::size_t vehicle = 0;
  plan::Breach breach;
};

struct Analysis {
  std::vector<Figures> vehicles;        ///< the whole flight, in the record's order
  std::vector<Pair> pairs;              ///< nearest first
  std::vector<VehicleBreach> breaches;  ///< in the order of time
};

/// Where the simulator parks vehicles is not the script's doing: a pair counts from when one of the two is that far
/// from where it stood.
inline constexpr double parking_m = 10.0;

[[nodiscard]] Analysis analyse(FlightRecord const& record, plan::Fence const& fence);

}  // namespace lapwing::dryrun
