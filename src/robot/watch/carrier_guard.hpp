#pragma once

#include <functional>
#include <string>

#include "base/async/scope.hpp"
#include "robot/carrier/carrier_client.hpp"
#include "robot/watch/module_watch.hpp"

namespace lapwing::robot {

/// Between whoever drives and the carrier: orders pass while every module is well, and the robot stops when one is not.
///
/// Looks every 20 ms, so that a module that falls silent has the robot braking within the watch period and a fiftieth
/// of a second. Thread-bound to its loop. The client and the watch must outlive it.
class CarrierGuard {
 public:
  struct Listener {
    /// It stopped because of this, or would not start.
    std::function<void(Clearance const&)> stopped;
    std::function<void()> free;
  };
  CarrierGuard(base::Loop& loop, CarrierClient& client, ModuleWatch& watch, Listener listener = {});

  /// As the client's, and refused with the module's name while one is not well.
  [[nodiscard]] base::Task<base::Result<>> carry_out(Order order, base::Duration timeout);
  base::Result<> begin(Order order);

  /// From the command centre, past the planner.
  void kill();
  /// The operator's. Error (refused): which module is not well.
  base::Result<> restart();

 private:
  base::Task<> look();
  [[nodiscard]] base::Result<> may_move() const;

  base::Loop& loop_;
  CarrierClient& client_;
  ModuleWatch& watch_;
  Listener listener_;
  bool was_free_ = false;
  base::Scope scope_;
};

}  // namespace lapwing::robot
