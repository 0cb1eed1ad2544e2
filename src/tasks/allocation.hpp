#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "tasks/task.hpp"

namespace lapwing::tasks {

/// One platform task of a tree and the vehicle that will do it.
struct Assignment {
  int occurrence = 0;  ///< counts the platform tasks of the tree depth first, left to right, from 0
  std::shared_ptr<PlatformTask const> task;
  VehicleId vehicle;
};

/// Which vehicle does what, decided before anything starts. In the order in which the choices were made.
struct Allocation {
  std::vector<Assignment> assignments;
};

/// Why the vehicle cannot carry out the task, or nothing.
using Unsuited = std::function<std::optional<std::string>(PlatformTask const&, VehicleInfo const&)>;
/// What the task says of itself.
[[nodiscard]] inline std::optional<std::string> unsuited_by_itself(PlatformTask const& task,
                                                                   VehicleInfo const& vehicle) {
  return task.unsuited(vehicle);
}

/// Gives every occurrence of a platform task one of the `available` vehicles (language spec, 4.5).
///
/// Of the suitable ones the first is taken; for a task with a reference position the nearest to it, the first of those
/// that are about as near, and within a sequence one that serves it already before any other. Parts of a sequence, and
/// the branches of a choice or allOf, share vehicles; parts of a concurrent never do, and those of its
/// parts that are bound to vehicle sets choose first. On failure nothing is assigned, and the error names the task and
/// why each vehicle was rejected.
[[nodiscard]] base::Result<Allocation> allocate(TaskTree const& tree, std::vector<VehicleInfo> const& available,
                                                Unsuited const& unsuited = unsuited_by_itself);

}  // namespace lapwing::tasks
