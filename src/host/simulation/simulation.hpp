#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host/links/ground.hpp"
#include "sim/world/world.hpp"

namespace lapwing::host {

/// "LAT,LON,ALT[,HDG]" in degrees and metres, as SITL spells it.
struct HomePlace {
  geo::Wgs84 place;
  double heading_rad = 0.0;
};
[[nodiscard]] base::Result<HomePlace> parse_home(std::string const& text);

/// "SPEED,FROM[,GUST]": m/s, degrees clockwise from north from which it blows, standard deviation of each component in
/// m/s; empty for still air. Errors: invalid_input.
[[nodiscard]] base::Result<> set_wind(sim::WorldOptions& world, std::string const& text);
inline constexpr auto wind_help = "SPEED,FROM[,GUST]: m/s, degrees from which it blows, strength of gusts";

/// For --swap-batteries of every verb that simulates.
inline constexpr auto swap_help =
    "A simulated vehicle that has stood disarmed for so many seconds gets a full battery; default: none ever does";

/// Puts the world where the user says (`--home`), else where the script is at home, else leaves it where it is.
[[nodiscard]] base::Result<> place(sim::WorldOptions& world, std::string const& said,
                                   std::optional<geo::Wgs84> const& home_of_script);

/// Simulated vehicles beside their ground station in one process, over MAVLink/UDP on loopback like any others. Listens
/// on the first free port from 14550 up.
[[nodiscard]] base::Result<std::unique_ptr<sim::World>> start_simulation(Ground& ground, sim::WorldOptions options,
                                                                         base::Logger log);

/// How loop time passes for `--speedup`: 0 means as fast as the machine computes. With a seed the calendar begins at
/// 2000-01-01, so that the run repeats.
[[nodiscard]] base::Loop::Pace pace_for(double speedup, std::optional<std::uint64_t> seed = std::nullopt);

}  // namespace lapwing::host
