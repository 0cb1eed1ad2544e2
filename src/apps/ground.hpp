#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/key_file.hpp"
#include "base/log.hpp"
#include "base/loop.hpp"
#include "fleet/control.hpp"
#include "fleet/fleet.hpp"
#include "fleet/platform.hpp"
#include "link/url.hpp"
#include "mavlink/connection.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::apps {

/// Where vehicles are waited for when the user names no link: loopback only.
inline constexpr auto default_link = "udpin://127.0.0.1:14550";

/// A link and the network of vehicles to which it belongs: "north=udpin://0.0.0.0:14551", or the URL alone for the one
/// network without a name. Each network has system ids of its own, so that there can be more than 255 vehicles.
struct NetworkLink {
  std::string network;
  link::Url url;
};
/// Error: invalid_input.
[[nodiscard]] base::Result<NetworkLink> parse_network_link(std::string const& text);

/// The ground side of one program: links, the vehicles on them, and the platform that flies missions on those.
struct Ground {
  Ground(base::Loop& loop, fleet::OnStop on_stop, base::Logger log, fleet::Fleet::Options fleet_options = {},
         tasks::PlanLibrary plans = {}, SigningSetup signing = {},
         vehicle::StopAction emergency_action = vehicle::StopAction::hold);

  /// Opens every link or none; makes the networks that they name. Errors: invalid_input for a wrong URL, io for a port
  /// in use.
  [[nodiscard]] base::Result<> open(std::vector<std::string> const& urls);
  /// Of every network, that without a name first.
  [[nodiscard]] std::vector<mavlink::LinkReport> link_reports() const;

  base::Loop& loop;
  base::Logger log;
  bool asks_for_messages;
  SigningSetup signing;
  mavlink::Connection connection;                       ///< of the network without a name
  std::map<std::string, mavlink::Connection> networks;  ///< the others, by name
  vehicle::Registry registry;
  fleet::Fleet fleet;
  fleet::FleetPlatform platform;
  fleet::Control control;  ///< what operators do with the vehicles

 private:
  [[nodiscard]] mavlink::Connection& connection_of(std::string const& network);
};

}  // namespace lapwing::apps
