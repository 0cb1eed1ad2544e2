#pragma once

#include <functional>
#include <memory>

#include "base/async/loop.hpp"

namespace lapwing::host {

/// Ctrl-C and SIGTERM: the first calls `stop` on the loop, a second ends the process at once with exit code 130.
class StopSignals {
 public:
  StopSignals(base::Loop& loop, std::function<void()> stop);
  ~StopSignals();
  StopSignals(StopSignals const&) = delete;
  StopSignals& operator=(StopSignals const&) = delete;

 private:
  struct Waiting;
  std::shared_ptr<Waiting> waiting_;
};

/// SIGHUP: calls `reload` on the loop, each time.
class ReloadSignal {
 public:
  ReloadSignal(base::Loop& loop, std::function<void()> reload);
  ~ReloadSignal();
  ReloadSignal(ReloadSignal const&) = delete;
  ReloadSignal& operator=(ReloadSignal const&) = delete;

 private:
  struct Waiting;
  std::shared_ptr<Waiting> waiting_;
};

}  // namespace lapwing::host
