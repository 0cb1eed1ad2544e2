#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "base/async/loop.hpp"

namespace lapwing::host {

/// Notices, by the wall's clock, that time on an unpaced loop does not go on: somebody is busy without end.
class StallWatch {
 public:
  /// Calls `on_stall` on the loop, once, when the program has been busy for about `patience` while its time stood
  /// still.
  StallWatch(base::Loop& loop, std::chrono::seconds patience, std::function<void()> on_stall);
  ~StallWatch();
  StallWatch(StallWatch const&) = delete;
  StallWatch& operator=(StallWatch const&) = delete;

 private:
  struct Waiting;
  std::shared_ptr<Waiting> waiting_;  // shared with the timer's handler
};

}  // namespace lapwing::host
