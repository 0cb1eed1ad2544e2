#pragma once

#include <string>
#include <vector>

#include "base/log.hpp"
#include "base/loop.hpp"
#include "fleet/control.hpp"
#include "fleet/fleet.hpp"
#include "fleet/platform.hpp"
#include "mavlink/connection.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::apps {

/// Where vehicles are waited for when the user names no link: loopback only.
inline constexpr auto default_link = "udpin://127.0.0.1:14550";

/// The ground side of one program: links, the vehicles on them, and the platform that flies missions on those.
struct Ground {
  Ground(base::Loop& loop, fleet::OnStop on_stop, base::Logger log, fleet::Fleet::Options fleet_options = {},
         tasks::PlanLibrary plans = {}, std::optional<mavlink::SigningKey> signing_key = std::nullopt,
         vehicle::StopAction emergency_action = vehicle::StopAction::hold);

  /// Opens every link or none. Errors: invalid_input for a wrong URL, io for a port in use.
  [[nodiscard]] base::Result<> open(std::vector<std::string> const& urls);

  base::Loop& loop;
  mavlink::Connection connection;
  vehicle::Registry registry;
  fleet::Fleet fleet;
  fleet::FleetPlatform platform;
  fleet::Control control;  ///< what operators do with the vehicles
};

}  // namespace lapwing::apps
