#pragma once

#include <optional>
#include <string>
#include <vector>

#include "autonomy/operator/report_reader.hpp"
#include "base/error.hpp"
#include "map/live/live_map.hpp"
#include "vehicle/survey_drones.hpp"

namespace lapwing::host {

/// Puts on the map what a survey drone has found: its occupancy map as the grid "DRONE parking" and its slots, in the
/// site "default"; where that is not on the map yet, it is put where the drone was armed.
class LotWriter {
 public:
  /// `map` outlives this.
  LotWriter(::lapwing::map::LiveMap& map, std::string drone) : map_(map), drone_(std::move(drone)) {}

  /// Where its local frame lies is told by the first heartbeat that has both places, and again by one that is more than
  /// `moved_m` off: it was armed elsewhere. Error: what is wrong with the map.
  [[nodiscard]] base::Result<> take(autonomy::report::Heartbeat const& heartbeat, base::UtcTime at);
  /// The whole map, of who is told of it beside heartbeats. It waits until a heartbeat tells where it lies.
  [[nodiscard]] base::Result<> take(autonomy::OccupancyMap const& told, base::UtcTime at);
  /// All that the drone knows: others of its slots are taken off the map. Errors: those of `read_features` and
  /// `LiveMap`.
  [[nodiscard]] base::Result<> take(autonomy::report::Slots const& told, base::UtcTime at);
  /// Of the drone's slots on the map; nothing before it has told of any.
  [[nodiscard]] std::optional<vehicle::SlotCounts> slots() const;

  static constexpr double moved_m = 3.0;

 private:
  void note_origin(autonomy::report::Heartbeat const& heartbeat);
  [[nodiscard]] base::Result<> put_grid(autonomy::OccupancyMap const& told, base::UtcTime at);
  [[nodiscard]] std::vector<std::string> slot_ids() const;
  [[nodiscard]] std::string id_of(std::string const& slot) const { return drone_ + " " + slot; }

  ::lapwing::map::LiveMap& map_;
  std::string drone_;
  std::optional<geo::Point<geo::SiteFrame>> origin_;  ///< of the local frame
  std::optional<autonomy::OccupancyMap> shown_;       ///< as it is on the map
  std::optional<autonomy::OccupancyMap> waiting_;     ///< until it is known where it lies
};

}  // namespace lapwing::host
