#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/log.hpp"
#include "dolphin/code/bytecode.hpp"
#include "dolphin/machine/signals.hpp"
#include "dolphin/syntax/limits.hpp"
#include "dolphin/value/objects.hpp"
#include "dolphin/value/output.hpp"
#include "dolphin/value/patterns.hpp"
#include "dolphin/value/value.hpp"
#include "tasks/execution.hpp"
#include "tasks/platform.hpp"
#include "vehicle/connection_timeout.hpp"

namespace lapwing::dolphin {

class Fiber;

/// Everything that the fibers of one program run share.
struct Runtime {
  base::Loop& loop;
  tasks::Platform& platform;
  Output& output;
  base::Logger log;
  std::shared_ptr<Program const> program;
  Limits limits = {};
  base::Duration tick = tasks::default_tick;
  std::mt19937_64 random = {};  ///< of `Math.random()`
  tasks::Execution::Observer observer = {};
  std::function<void(tasks::TaskView)> on_executed = {};

  Heap heap = {};
  Patterns patterns = {};
  std::uint64_t steps = 0;  ///< instructions carried out
  std::vector<Value> globals = {};
  std::vector<bool> is_defined = {};  ///< of each global: has it got a value yet
  Signals signals = {};
  std::vector<tasks::VehicleId> picked = {};
  base::Duration connection_timeout = vehicle::default_connection_timeout;
  std::map<std::string, Ref<TaskValue>> plans = {};  ///< those of the script with a name, each one `Performed`
  std::set<tasks::VehicleId> batteries_warned_of = {};
  std::set<tasks::VehicleId> batteries_waited_for = {};
  tasks::Execution* execution = nullptr;  ///< the one that is on its way
};

/// A closure as a guard or a procedure of tasks. The runtime outlives it.
[[nodiscard]] std::shared_ptr<tasks::Guard const> make_guard(Runtime& runtime, Ref<Closure> closure);
[[nodiscard]] std::shared_ptr<tasks::Procedure const> make_action(Runtime& runtime, Ref<Closure> closure);
[[nodiscard]] std::shared_ptr<tasks::Procedure const> make_handler(Runtime& runtime, Ref<Closure> closure);

/// Runs the fiber to its end, turn by turn.
[[nodiscard]] base::Task<void> drive(Runtime& runtime, Fiber& fiber);

}  // namespace lapwing::dolphin
