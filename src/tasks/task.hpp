#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "tasks/closure.hpp"
#include "tasks/platform.hpp"
#include "vehicle/vehicle_id.hpp"

/// Task expressions as values: what `a >> b`, `t / { c }` or `allOf { ... }` build. Never changed once made, so any
/// number of trees and executions may share parts of each other; one part that stands twice in a tree is two
/// *occurrences*.
namespace lapwing::tasks {

struct TaskNode;
/// Shared because the same task value stands in many trees and outlives the script variable that named it.
using TaskTree = std::shared_ptr<TaskNode const>;

/// Parts one after the other.
struct Sequence {
  std::vector<TaskTree> parts;
};
/// All parts at once, on different vehicles; a failing part stops the others.
struct Concurrent {
  std::vector<TaskTree> parts;
};
/// The body, until the guard holds. A guard that holds from the outset means that the body never starts.
struct Until {
  TaskTree body;
  std::shared_ptr<Guard const> guard;
};
/// The body, for at most `limit` after its start.
struct During {
  TaskTree body;
  base::Duration limit{};
};
struct Branch {
  std::shared_ptr<Guard const> when;
  TaskTree then;
};
/// Waits until a guard holds and becomes the task of the first such branch. `waitFor` is a choice of one.
struct Choice {
  std::vector<Branch> branches;
};
/// Runs every branch once, one at a time, each when its guard holds.
struct AllOf {
  std::vector<Branch> branches;
};
/// The body; if it fails, the handler decides whether that counts.
struct Watch {
  TaskTree body;
  std::shared_ptr<Procedure const> on_error;
};
struct Action {
  std::shared_ptr<Procedure const> body;
};
/// Done once the guard holds.
struct Condition {
  std::shared_ptr<Guard const> guard;
};
/// Done after `length`; never if there is none.
struct Idle {
  std::optional<base::Duration> length;
};
/// `t[v]`: the body may use these vehicles only.
struct Restricted {
  TaskTree body;
  std::vector<VehicleId> vehicles;
};
/// Something one vehicle does.
struct Performed {
  std::shared_ptr<PlatformTask const> task;
};

using TaskKind = std::variant<Sequence, Concurrent, Until, During, Choice, AllOf, Watch, Action, Condition, Idle,
                              Restricted, Performed>;

/// Where a task stands in the script, for views and reports.
struct Origin {
  int line = 0;            ///< 0: unknown
  std::string label = {};  ///< short source excerpt; empty: the task's name
};

struct TaskNode {
  TaskKind kind;
  Origin origin;
  int depth = 1;               ///< nodes on the longest way down
  int size = 1;                ///< occurrences of tasks in it, itself included; `too_large` when there are more
  int performed = 0;           ///< those of platform tasks
  std::size_t bytes = 0;       ///< memory that it keeps, roughly
  bool is_restricted = false;  ///< it or something in it is bound to a vehicle set
};

/// Trees deeper or larger than this are refused by `allocate`; the language refuses to build them. A tree that shares
/// its parts grows by doubling, so its size says what an execution would take, not its memory.
inline constexpr int max_task_depth = 1000;
inline constexpr int max_task_size = 20'000;
inline constexpr int too_large = 1'000'000'000;

// The only ways to make a tree. Sequences of sequences and concurrents of concurrents become flat ones: the operators
// are associative.
[[nodiscard]] TaskTree sequence(TaskTree first, TaskTree second, Origin origin = {});
[[nodiscard]] TaskTree concurrent(TaskTree left, TaskTree right, Origin origin = {});
[[nodiscard]] TaskTree until(TaskTree body, std::shared_ptr<Guard const> guard, Origin origin = {});
[[nodiscard]] TaskTree during(TaskTree body, base::Duration limit, Origin origin = {});
/// Fails with "No choices were defined!" when there is no branch.
[[nodiscard]] base::Result<TaskTree> one_of(std::vector<Branch> branches, Origin origin = {});
[[nodiscard]] TaskTree wait_for(std::shared_ptr<Guard const> when, TaskTree then, Origin origin = {});
[[nodiscard]] TaskTree all_of(std::vector<Branch> branches, Origin origin = {});
[[nodiscard]] TaskTree watch(TaskTree body, std::shared_ptr<Procedure const> on_error, Origin origin = {});
[[nodiscard]] TaskTree action(std::shared_ptr<Procedure const> body, Origin origin = {});
[[nodiscard]] TaskTree condition(std::shared_ptr<Guard const> guard, Origin origin = {});
[[nodiscard]] TaskTree idle(std::optional<base::Duration> length, Origin origin = {});
[[nodiscard]] TaskTree restricted(TaskTree body, std::vector<VehicleId> vehicles, Origin origin = {});
[[nodiscard]] TaskTree performed(std::shared_ptr<PlatformTask const> task, Origin origin = {});

/// How a task prints: `survey >> home`, `<choice>`, `idle(0.500000)`. Guards and restrictions print as their inner
/// task. Long sequences are cut with "…".
[[nodiscard]] std::string name(TaskTree const& task);

}  // namespace lapwing::tasks
