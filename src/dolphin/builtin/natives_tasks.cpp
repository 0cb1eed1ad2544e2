#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "base/text/spelling.hpp"
#include "dolphin/builtin/internal/native_lists.hpp"
#include "dolphin/machine/fiber.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/names/row_parameters.hpp"
#include "dolphin/value/operators.hpp"
#include "dolphin/value/text.hpp"

/// Task constructors and `execute` (language spec, 3.4 and 4.2).
namespace lapwing::dolphin::internal {
namespace {

std::unexpected<Fault> wrong_argument(std::string_view what, std::string_view wanted, Value const& given) {
  return fault(fmt::format("{} takes {}, not {}", what, wanted, kind_name(given)), "IllegalArgumentException");
}

tasks::Origin origin(Fiber const& fiber) {
  return {.line = static_cast<int>(fiber.line())};
}

/// The error with what may have been meant: missions of the script and plans of the platform.
std::string no_plan(Runtime const& runtime, std::string const& name, base::Error const& error) {
  auto known = runtime.platform.plan_names();
  for (auto const& [own, task] : runtime.plans) known.push_back(own);
  std::vector<std::string_view> const names(known.begin(), known.end());
  std::string hint = error.kind == base::ErrorKind::not_found ? base::did_you_mean(name, names) : "";
  constexpr std::size_t most_named = 12;
  if (hint.empty()) hint = error.hint;
  if (hint.empty() && !names.empty() && names.size() <= most_named)
    hint = fmt::format("the plans are {}", fmt::join(names, ", "));
  return hint.empty() ? error.message : fmt::format("{}: {}", error.message, hint);
}

Checked<Value> named_task(Runtime& runtime, Fiber& fiber, Arguments arguments) {
  auto const name = to_text(arguments[0]);
  if (auto const own = runtime.plans.find(name); own != runtime.plans.end()) {
    auto const& plan = std::get<tasks::Performed>(own->second->value->kind);
    return task_value(runtime.heap, tasks::performed(plan.task, origin(fiber)));
  }
  auto task = runtime.platform.named_task(name);
  if (!task) return fault(no_plan(runtime, name, task.error()), "IllegalArgumentException");
  return task_value(runtime.heap, tasks::performed(std::move(*task), origin(fiber)));
}

Checked<base::Duration> duration_of(Value const& value, std::string_view what) {
  if (!value.is_number()) return wrong_argument(what, "seconds", value);
  if (!(value.number() >= 0.0) || value.number() > 1e9) {
    return fault(fmt::format("{} takes seconds, 0 or more", what), "IllegalArgumentException");
  }
  return base::from_seconds(value.number());
}

Checked<Value> idle(Runtime& runtime, Fiber& fiber, Arguments arguments) {
  if (arguments.empty()) return task_value(runtime.heap, tasks::idle(std::nullopt, origin(fiber)));
  auto const length = duration_of(arguments[0], "idle");
  if (!length) return std::unexpected(length.error());
  return task_value(runtime.heap, tasks::idle(*length, origin(fiber)));
}

Checked<Value> action(Runtime& runtime, Fiber& fiber, Arguments arguments) {
  auto* body = arguments[0].as<Closure>();
  if (!body) return wrong_argument("action", "a closure", arguments[0]);
  return task_value(runtime.heap, tasks::action(make_action(runtime, Ref<Closure>(body)), origin(fiber)));
}

Checked<Value> condition(Runtime& runtime, Fiber& fiber, Arguments arguments) {
  auto* guard = arguments[0].as<Closure>();
  if (!guard) return wrong_argument("condition", "a closure", arguments[0]);
  return task_value(runtime.heap, tasks::condition(make_guard(runtime, Ref<Closure>(guard)), origin(fiber)));
}

Checked<Value> wait_for(Runtime& runtime, Fiber& fiber, Arguments arguments) {
  auto* guard = arguments[0].as<Closure>();
  auto const* body = arguments[1].as<TaskValue>();
  if (!guard) return wrong_argument("waitFor", "a closure", arguments[0]);
  if (!body) return wrong_argument("then", "a task", arguments[1]);
  return task_value(runtime.heap,
                    tasks::wait_for(make_guard(runtime, Ref<Closure>(guard)), body->value, origin(fiber)));
}

Checked<Value> until(Runtime& runtime, Fiber& fiber, Arguments arguments) {
  auto* guard = arguments[0].as<Closure>();
  auto const* body = arguments[1].as<TaskValue>();
  if (!guard) return wrong_argument("until", "a closure", arguments[0]);
  if (!body) return wrong_argument("run", "a task", arguments[1]);
  return task_value(runtime.heap, tasks::until(body->value, make_guard(runtime, Ref<Closure>(guard)), origin(fiber)));
}

Checked<Value> during(Runtime& runtime, Fiber& fiber, Arguments arguments) {
  auto const limit = duration_of(arguments[0], "during");
  if (!limit) return std::unexpected(limit.error());
  auto const* body = arguments[1].as<TaskValue>();
  if (!body) return wrong_argument("run", "a task", arguments[1]);
  return task_value(runtime.heap, tasks::during(body->value, *limit, origin(fiber)));
}

Checked<Value> watch(Runtime& runtime, Fiber& fiber, Arguments arguments) {
  auto const* body = arguments[0].as<TaskValue>();
  auto* handler = arguments[1].as<Closure>();
  if (!body) return wrong_argument("watch", "a task", arguments[0]);
  if (!handler) return wrong_argument("onError", "a closure", arguments[1]);
  return task_value(runtime.heap,
                    tasks::watch(body->value, make_handler(runtime, Ref<Closure>(handler)), origin(fiber)));
}

template <bool ignores>
Checked<Value> decide(Runtime& /*runtime*/, Fiber& fiber, Arguments /*arguments*/) {
  if (fiber.role() != Fiber::Role::handler) {
    return fault(fmt::format("{} stands only in the closure of onError", ignores ? "ignore()" : "propagate()"),
                 "IllegalStateException");
  }
  fiber.ignores_failure = ignores;
  return Value();
}

// ---- execute

bool is_picked(Runtime const& runtime, tasks::VehicleId const& id) {
  return std::ranges::find(runtime.picked, id) != runtime.picked.end();
}

/// What to run, and what to add to the message when there are no vehicles for it.
struct Order {
  tasks::TaskTree tree;
  std::string remarks;
};

std::optional<std::vector<tasks::VehicleId>> members(Value const& value) {
  if (auto const* set = value.as<Vehicles>()) return set->ids;
  if (auto const* one = value.as<Vehicle>()) return std::vector{one->value};
  return std::nullopt;
}

/// From name, vehicles and task of every part: one concurrent task, in written order (REC-14).
Checked<Order> keyed_order(Runtime const& runtime, Arguments parts, tasks::Origin const& where) {
  Order order;
  for (std::size_t i = 0; i < parts.size(); i += 3) {
    auto const key = to_text(parts[i]);
    auto const* task = parts[i + 2].as<TaskValue>();
    if (!task) return wrong_argument(fmt::format("execute {}:", key), "a task", parts[i + 2]);
    auto tree = task->value;
    if (key != "_") {
      auto const ids = members(parts[i + 1]);
      if (!ids) return halting(fmt::format("'{}' does not identify a vehicle set", key));
      for (auto const& id : *ids) {
        if (!is_picked(runtime, id)) order.remarks += fmt::format("; {}: vehicle {} is not picked", key, id.text);
      }
      if (ids->empty()) order.remarks += fmt::format("; {} is an empty set", key);
      tree = tasks::restricted(std::move(tree), *ids, where);
    }
    order.tree = order.tree ? tasks::concurrent(std::move(order.tree), std::move(tree), where) : std::move(tree);
  }
  return order;
}

Fault as_fault(tasks::Failure const& failure) {
  if (failure.payload)
    return {.type = {}, .message = {}, .thrown = *std::static_pointer_cast<Value const>(failure.payload)};
  bool const halts = failure.kind == tasks::FailureKind::halt || failure.vehicle_failed;
  auto const ending = halts ? Ending::halts_unless_caught : Ending::error;
  return {"TaskError", failure.message, ending};
}

/// Says for the time of an execution that it is the one on its way, and shows how it stood at its end, however that
/// came.
class OnItsWay {
 public:
  OnItsWay(Runtime& runtime, tasks::Execution& execution) : runtime_(runtime), execution_(execution) {
    runtime_.execution = &execution;
  }
  OnItsWay(OnItsWay const&) = delete;
  OnItsWay& operator=(OnItsWay const&) = delete;
  ~OnItsWay() {
    execution_.stop(runtime_.loop.now());
    runtime_.execution = nullptr;
    if (runtime_.on_executed) runtime_.on_executed(execution_.view());
  }

 private:
  Runtime& runtime_;
  tasks::Execution& execution_;
};

/// A mistake in the script, or the lack of a vehicle that was lost since it was picked.
std::unexpected<Fault> unallocated(std::string message, std::vector<tasks::VehicleInfo> const& available) {
  bool const all_are_there = std::ranges::all_of(available, &tasks::VehicleInfo::connected);
  return all_are_there ? fault(std::move(message), "TaskError") : halting(std::move(message), "TaskError");
}

base::Task<Checked<Value>> run(Runtime& runtime, Order order) {
  std::vector<tasks::VehicleInfo> available;
  for (auto const& id : runtime.picked) {
    if (auto info = runtime.platform.find(id)) available.push_back(std::move(*info));
  }
  tasks::Unsuited const unsuited = [&runtime](tasks::PlatformTask const& task, tasks::VehicleInfo const& vehicle) {
    return runtime.platform.unsuited(task, vehicle);
  };
  auto const allocation = tasks::allocate(order.tree, available, unsuited);
  if (!allocation) {
    runtime.log.warn(fmt::format("Task {} could not allocate necessary nodes.", tasks::name(order.tree)));
    co_return unallocated(allocation.error().message + order.remarks, available);
  }
  for (auto const& one : allocation->assignments) {
    runtime.log.info(fmt::format("Task {} allocated node {}.", one.task->name(), one.vehicle.text));
  }
  tasks::Execution execution(order.tree, *allocation, runtime.platform, runtime.observer);
  OnItsWay const on_its_way(runtime, execution);
  auto running = tasks::run(runtime.loop, execution, runtime.tick);
  auto const outcome = co_await running;
  if (outcome.failure) co_return std::unexpected(as_fault(*outcome.failure));
  OutcomeData data;
  for (auto const& assignment : allocation->assignments) {
    if (std::ranges::find(data.vehicles, assignment.vehicle) == data.vehicles.end())
      data.vehicles.push_back(assignment.vehicle);
  }
  co_return Value(runtime.heap.make<ExecuteOutcome>(std::move(data)));
}

Checked<void> may_execute(Runtime const& runtime, Fiber const& fiber) {
  bool const is_inside = fiber.role() != Fiber::Role::script || runtime.execution;
  if (is_inside) return fault("execute inside a task", "IllegalStateException");
  return {};
}

base::Task<Checked<Value>> execute(Runtime& runtime, Fiber& fiber, std::vector<Value> arguments) {
  if (auto const may = may_execute(runtime, fiber); !may) co_return std::unexpected(may.error());
  auto const* task = arguments[0].as<TaskValue>();
  if (!task) co_return wrong_argument("execute", "a task", arguments[0]);
  Order order{task->value, {}};
  auto running = run(runtime, std::move(order));
  co_return co_await running;
}

base::Task<Checked<Value>> execute_keyed(Runtime& runtime, Fiber& fiber, std::vector<Value> arguments) {
  if (auto const may = may_execute(runtime, fiber); !may) co_return std::unexpected(may.error());
  auto order = keyed_order(runtime, arguments, origin(fiber));
  if (!order) co_return std::unexpected(order.error());
  auto running = run(runtime, std::move(*order));
  co_return co_await running;
}

}  // namespace

std::vector<InstructionSpec> task_words() {
  using namespace rows;
  return {
      {.name = "task",
       .signatures = {takes({plain("name", text)})},
       .result = task,
       .doc = "The mission of this script that has the name, or the plan file of `--plans DIR`: north.plan or "
              "north.waypoints for 'north'. On the test platform 'A:3' is a task of 3 s and 'fail:3' one that fails.",
       .example = "north = mission { name 'north'; home 41.178, -8.598, 90; move 50, 0 }\nv = pick {}\nexecute v: "
                  "task('north')",
       .call = named_task},
      {.name = "imcPlan",
       .signatures = {takes({plain("name", text)})},
       .result = task,
       .doc = "The same as `task`; also written `imcPlan['north']`.",
       .call = named_task},
      {.name = "idle",
       .signatures = {takes({maybe(seconds("time"))})},
       .result = task,
       .doc = "Does nothing for that long; without a time it never ends by itself. Needs no vehicle.",
       .example = "execute idle(10.seconds)",
       .call = idle},
      {.name = "action",
       .signatures = {takes({plain("body", closure)})},
       .result = task,
       .doc = "Runs the closure once. Needs no vehicle. An exception in it is an error of the task.",
       .example = "execute idle(1) >> action { message 'a second later' }",
       .call = action},
      {.name = "condition",
       .signatures = {takes({plain("test", closure)})},
       .result = task,
       .doc = "Done when the closure is true; tested at every step. Needs no vehicle.",
       .example = "v = pick {}\nexecute condition { battery(v) > 95.percent }",
       .call = condition},
      {.name = "oneOf",
       .signatures = {takes({plain("branches", closure)})},
       .result = task,
       .doc =
           "Tests the guards of its branches in order, at every step; the first that is true decides which one runs.",
       .block = BlockKind::choice,
       .example =
           "v = pick {}\nexecute oneOf {\n  when { battery(v) < 0.5 } then idle(60)\n  when { true } then idle(1)\n}"},
      {.name = "choose",
       .signatures = {takes({plain("branches", closure)})},
       .result = task,
       .doc = "The same as `oneOf`.",
       .block = BlockKind::choice},
      {.name = "allOf",
       .signatures = {takes({plain("branches", closure)})},
       .result = task,
       .doc = "Runs every branch, one at a time, each when its guard is true; done when all have run.",
       .block = BlockKind::choice,
       .example =
           "execute allOf {\n  when { poll 'ready' } then idle(1)\n  when { true } then action { post ready: 1 }\n}"},
      {.name = "execute",
       .signatures = {takes({plain("task", task)})},
       .result = Kind::other,
       .doc = "Runs the task to its end; `execute v1: a, v2: b` runs several at once, each on its vehicles, `_` on "
              "any. Gives a result with `done`, `error` and `vehicles`; a task that fails throws a TaskError.",
       .named = NamedArguments::vehicles,
       .example = "v = pick {}\nr = execute v: idle(1), _: action { message 'begun' }\nmessage r.done",
       .start = execute},
  };
}

std::vector<InstructionSpec> task_helpers() {
  return {
      {.name = "waitFor", .call = wait_for},
      {.name = "until", .call = until},
      {.name = "duringSeconds", .call = during},
      {.name = "watch", .call = watch},
      {.name = "execute keyed", .start = execute_keyed},
  };
}

std::vector<InstructionSpec> handler_words() {
  using namespace rows;
  return {
      {.name = "ignore", .signatures = {takes({})}, .doc = "The watched task counts as done.", .call = decide<true>},
      {.name = "propagate",
       .signatures = {takes({})},
       .doc = "The watched task counts as failed (the default).",
       .call = decide<false>},
  };
}

}  // namespace lapwing::dolphin::internal
