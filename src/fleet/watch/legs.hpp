#pragma once

#include <optional>
#include <vector>

#include "base/time.hpp"
#include "geo/position.hpp"
#include "mavlink/codec/messages.hpp"
#include "vehicle/family.hpp"

namespace lapwing::fleet {

/// The items of a mission as what a vehicle does at each of them. Sequence numbers as on the vehicle.
class Legs {
 public:
  Legs(std::vector<mavlink::MissionItem> items, std::optional<geo::Wgs84> home, vehicle::Family family);

  /// The navigation item that is carried out when the vehicle names this one: itself, or what follows it. Null behind
  /// the last.
  [[nodiscard]] mavlink::MissionItem const* at(int seq) const;
  /// A copter that carries out this item is in the air: not before its take-off, and not where it lands.
  [[nodiscard]] bool is_in_the_air(int seq) const;
  /// Where a vehicle at `here` is going. Nothing where the item has no place, or takes it round one.
  [[nodiscard]] std::optional<geo::Wgs84> target(int seq, geo::Wgs84 here) const;
  /// How long a vehicle at `here` may be without getting any nearer to the end of the item: a minute and twice what the
  /// item is estimated to take with its waits. Nothing when it may take for ever, or nobody knows.
  [[nodiscard]] std::optional<base::Duration> patience(int seq, geo::Wgs84 here) const;

 private:
  std::vector<mavlink::MissionItem> items_;
  std::optional<geo::Wgs84> home_;
  vehicle::Family family_;
  std::vector<bool> in_the_air_;
};

/// Commands that follow each other; what is none is done on the way.
[[nodiscard]] bool is_navigation(mavlink::MavCmd command);

}  // namespace lapwing::fleet
