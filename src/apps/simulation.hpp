#pragma once

#include <memory>
#include <string>

#include "apps/ground.hpp"
#include "sim/world.hpp"

namespace lapwing::apps {

/// "LAT,LON,ALT[,HDG]" in degrees and metres, as SITL spells it.
struct HomePlace {
  geo::Wgs84 place;
  double heading_rad = 0.0;
};
[[nodiscard]] base::Result<HomePlace> parse_home(std::string const& text);

/// For --swap-batteries of every verb that simulates.
inline constexpr auto swap_help =
    "A simulated vehicle that has stood disarmed for so many seconds gets a full battery; default: none ever does";

/// Simulated vehicles beside their ground station in one process, over MAVLink/UDP on loopback like any others. Listens
/// on the first free port from 14550 up.
[[nodiscard]] base::Result<std::unique_ptr<sim::World>> start_simulation(Ground& ground, sim::WorldOptions options,
                                                                         base::Logger log);

/// How loop time passes for `--speedup`: 0 means as fast as the machine computes. With a seed the calendar begins at
/// 2000-01-01, so that the run repeats.
[[nodiscard]] base::Loop::Pace pace_for(double speedup, std::optional<std::uint64_t> seed = std::nullopt);

}  // namespace lapwing::apps
