#pragma once

#include <functional>
#include <map>
#include <vector>

#include "base/async/notifier.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::vehicle {

/// Every vehicle known to this process, by id in numeric-then-text order. The one place where vehicle state lives.
///
/// Platforms write, everybody else reads. Thread-bound to its loop.
class Registry {
 public:
  explicit Registry(base::Loop& loop) : changed_(loop) {}

  /// The state to write into; made on first use. Call `touch` once the update is whole.
  [[nodiscard]] VehicleState& edit(VehicleId const& id);
  [[nodiscard]] VehicleState const* find(VehicleId const& id) const;
  [[nodiscard]] std::vector<VehicleState const*> all() const;

  /// Tells readers that `id` changed: bumps its revision. `membership` when it appeared, was lost or came back.
  void touch(VehicleId const& id);
  void touch_membership(VehicleId const& id);
  /// Grows with every touch of that vehicle; 0 for a vehicle never touched. A reader that remembers it can send only
  /// news.
  [[nodiscard]] unsigned long long revision(VehicleId const& id) const;
  /// Notified when vehicles appear, are lost or return (not for every telemetry message).
  [[nodiscard]] base::Notifier& membership_changed() const { return changed_; }

 private:
  struct NumericOrder {
    bool operator()(VehicleId const& a, VehicleId const& b) const;
  };
  struct Entry {
    VehicleState state;
    unsigned long long revision = 0;
  };
  mutable base::Notifier changed_;  ///< readers wait on it
  std::map<VehicleId, Entry, NumericOrder> entries_;
};

}  // namespace lapwing::vehicle
