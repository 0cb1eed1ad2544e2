#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/log.hpp"
#include "fleet/network/fleet.hpp"
#include "host/files/key_file.hpp"
#include "link/url.hpp"
#include "mavlink/connection/connection.hpp"
#include "parameters/cache.hpp"
#include "vehicle/authority.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::host {

/// Where vehicles are waited for when the user names no link: loopback only.
inline constexpr auto default_link = "udpin://127.0.0.1:14550";

/// Where every program of this user keeps what vehicles' parameters were.
[[nodiscard]] parameters::Cache parameter_cache();

/// A link and the network of vehicles to which it belongs: "north=udpin://0.0.0.0:14551", or the URL alone for the one
/// network without a name. Each network has system ids of its own, so that there can be more than 255 vehicles.
struct NetworkLink {
  std::string network;
  link::Url url;
};
/// Error: invalid_input.
[[nodiscard]] base::Result<NetworkLink> parse_network_link(std::string const& text);

/// The ground side of one program: links, and the vehicles on them, network by network.
struct Ground {
  Ground(base::Loop& loop, base::Logger log, fleet::Fleet::Options fleet_options = {}, SigningSetup signing = {});

  /// Opens every link or none; makes the networks that they name. Errors: invalid_input for a wrong URL, io for a port
  /// in use.
  [[nodiscard]] base::Result<> open(std::vector<std::string> const& urls);
  /// Its connection. Error: invalid_input when no link belongs to such a network; the one without a name is always
  /// there.
  [[nodiscard]] base::Result<mavlink::Connection*> network(std::string const& name);
  /// Of every network, that without a name first.
  [[nodiscard]] std::vector<mavlink::LinkReport> link_reports() const;
  /// The latest time of a signature on any network; 0 when nothing is signed.
  [[nodiscard]] mavlink::SigningTime signed_until() const;

  base::Loop& loop;
  base::Logger log;
  bool asks_for_messages;
  SigningSetup signing;
  std::map<std::string, mavlink::Connection> networks;  ///< by name; the first has none
  mavlink::Connection& connection;                      ///< of that one
  vehicle::Registry registry;                           ///< the vehicles of every platform
  vehicle::Authority authority;                         ///< who commands them
  fleet::Fleet fleet;

 private:
  [[nodiscard]] mavlink::Connection& made(std::string const& network);
};

}  // namespace lapwing::host
