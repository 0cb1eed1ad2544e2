#pragma once

#include <deque>
#include <map>
#include <string>

#include "base/log.hpp"
#include "fleet/network/fleet.hpp"

namespace lapwing::fleet {

/// Notices what other ground stations do to the vehicles of a fleet: their heartbeats, their commands and what vehicles
/// answer to them, plans that they have changed, and modes that nobody here asked for. Tells it in the log and in the
/// vehicle's `foreign_change`. Thread-bound.
class OtherStations {
 public:
  /// The fleet outlives this.
  OtherStations(Fleet& fleet, base::Logger log);
  OtherStations(OtherStations const&) = delete;
  OtherStations& operator=(OtherStations const&) = delete;

 private:
  void take(Network& network, mavlink::Received const& received);
  void take_heartbeat(Network& network, mavlink::Received const& received, mavlink::Heartbeat const& heartbeat);
  void take_answer(Network& network, mavlink::Received const& received);
  void note_command(Network& network, mavlink::Address by, mavlink::Address target, mavlink::MavCmd command,
                    std::string_view outcome);
  void note_mode(MavlinkVehicle& craft, std::uint32_t before);
  void tell(MavlinkVehicle& craft, std::string what);
  [[nodiscard]] std::string suspects() const;

  struct Told {
    std::string what;
    base::TimePoint at{};
  };

  Fleet& fleet_;
  base::Logger log_;
  std::map<mavlink::Address, base::TimePoint> stations_;  ///< heard, and when last
  std::map<vehicle::VehicleId, std::uint32_t> modes_;     ///< of the last heartbeat
  std::map<vehicle::VehicleId, std::deque<Told>> told_;   ///< lately, not to be told again and again
  std::shared_ptr<Fleet::Heard const> subscription_;
};

}  // namespace lapwing::fleet
