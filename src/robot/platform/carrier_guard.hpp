#pragma once

#include <functional>

#include "base/async/loop.hpp"
#include "base/async/scope.hpp"
#include "robot/platform/body.hpp"
#include "robot/watch/module_watch.hpp"

namespace lapwing::robot {

/// Between whoever drives and the carrier: motions pass while every module is well, and the robot stops when one is
/// not.
///
/// Looks every 20 ms, so that a module that falls silent has the robot braking within the watch period and a fiftieth
/// of a second. Thread-bound to its loop. The body and the watch must outlive it.
class CarrierGuard {
 public:
  struct Listener {
    /// It may not move any more, because of this.
    std::function<void(Clearance const&)> stopped;
    std::function<void()> free;
  };
  CarrierGuard(base::Loop& loop, Body& body, ModuleWatch& watch, Listener listener = {});

  /// Gives what the body was told: this motion, or to stand while one is not well.
  Motion drive(Motion motion);
  /// From the command centre, past the planner.
  void kill();
  /// The operator's. Error (refused): which module is not well.
  base::Result<> restart();

 private:
  base::Task<> look();

  base::Loop& loop_;
  Body& body_;
  ModuleWatch& watch_;
  Listener listener_;
  bool was_free_ = false;
  base::Scope scope_;
};

}  // namespace lapwing::robot
