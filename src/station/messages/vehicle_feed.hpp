#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "vehicle/registry.hpp"

namespace lapwing::station {

/// Turns the registry into `vehicles`, `plan` and `pictures` messages: everything for a newcomer, only news for the
/// others.
///
/// Each field of a vehicle is news when its value or the time at which it was heard changed. Ages go as seconds at the
/// moment of encoding, so client and station need no common clock.
class VehicleFeed {
 public:
  explicit VehicleFeed(vehicle::Registry const& registry);
  ~VehicleFeed();

  /// A full `vehicles` message, the `plan` of every vehicle, and the `pictures` of those that took some.
  [[nodiscard]] std::vector<std::string> snapshot(base::TimePoint now) const;
  /// What changed since the last call: at most one `vehicles` message, and the plans and pictures that are new. Empty
  /// when nothing is.
  [[nodiscard]] std::vector<std::string> news(base::TimePoint now);
  /// The full message alone, for `GET /api/v1/vehicles`.
  [[nodiscard]] std::string vehicles_message(base::TimePoint now) const;

 private:
  struct Sent;
  vehicle::Registry const& registry_;
  std::unique_ptr<Sent> sent_;
};

}  // namespace lapwing::station
