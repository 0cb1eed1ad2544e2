#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/log.hpp"
#include "link/impaired_link.hpp"
#include "link/url.hpp"
#include "sim/model/vehicle_spec.hpp"
#include "sim/world/vehicle.hpp"

namespace lapwing::sim {

enum class BootStyle { quick, realistic };

/// What a simulated world is made of.
struct WorldOptions {
  std::vector<VehicleGroup> vehicles = {{}};
  /// A car park that does not exist. Altitude above mean sea level; the world's ground is level there.
  geo::Wgs84 home = geo::Wgs84::from_degrees(41.1780, -8.5980, 90.0);
  double heading_rad = 0.0;
  double altitude_error_m = 0.0;  ///< see `Vehicle::Options`
  /// Where each vehicle sends: its own socket, from a port of its own.
  link::Url out{link::Transport::udp_out, "127.0.0.1", 14550};
  std::uint64_t seed = 1;
  int first_system_id = 1;
  geo::Ned wind_m_s;                 ///< where the air goes
  double gust_m_s = 0.0;             ///< standard deviation
  link::Impairment impairment = {};  ///< of every vehicle's link, in each direction; its seed is set from `seed`
  BootStyle boot = BootStyle::quick;
  double battery_capacity_mah = 5000.0;
  std::optional<base::Duration> battery_swap_after = std::nullopt;  ///< see `Vehicle::Options`
  std::optional<mavlink::KeyRing> keys = std::nullopt;              ///< each vehicle has its own of these
  std::vector<ParameterSetting> parameters = {};                    ///< for every vehicle that has them
};

/// The simulated vehicles of one site, numbered from `first_system_id`, parked in rows a few metres apart.
///
/// Runs on the loop by itself until destroyed; under an unpaced loop as fast as the machine computes.
class World {
 public:
  /// How a vehicle gets its link. The default opens `out`; tests give pipes.
  using OpenLink = Vehicle::OpenLink;

  World(base::Loop& loop, WorldOptions options, base::Logger log);
  /// The same over links from `open_link`, which is asked at each power-on.
  World(base::Loop& loop, WorldOptions options, OpenLink open_link, base::Logger log);

  /// Powers all vehicles on. Errors: those of the links, or invalid_input when the system ids do not suffice or no
  /// vehicle has a parameter of that name.
  base::Result<> start();

  [[nodiscard]] std::vector<std::unique_ptr<Vehicle>> const& vehicles() const { return vehicles_; }
  /// By system id; null when there is none.
  [[nodiscard]] Vehicle* find(int system_id);
  [[nodiscard]] Site const& site() const { return site_; }
  [[nodiscard]] WorldOptions const& options() const { return options_; }

 private:
  void park(VehicleGroup const& group, int system_id);
  base::Result<> set_parameters();

  base::Loop& loop_;
  WorldOptions options_;
  OpenLink open_link_;
  base::Logger log_;
  Site site_;
  std::vector<std::unique_ptr<Vehicle>> vehicles_;
};

}  // namespace lapwing::sim
