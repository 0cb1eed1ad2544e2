#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "geo/position.hpp"
#include "vehicle/vehicle_id.hpp"

namespace lapwing::tasks {

class PlatformTask;

enum class TaskState { waiting, running, done, failed, stopped };
[[nodiscard]] std::string_view to_string(TaskState state);

/// A picture of one node of a running task tree, for people and reports. Plain data: the station sends it, `run`
/// reports it.
struct TaskView {
  int id = 0;         ///< unique within one execution, depth-first order
  std::string kind;   ///< "sequence", "concurrent", "mission", "until", "watch", "action" ...
  std::string label;  ///< the mission's name, or a short source excerpt
  int line = 0;       ///< in the script; 0 when unknown
  TaskState state = TaskState::waiting;
  std::optional<vehicle::VehicleId> vehicle;  ///< of platform tasks
  std::string detail;                         ///< "item 3/12", or the error
  std::vector<TaskView> children;
};

/// One thing that happened to a task. `--events` writes these; the station logs them.
struct TaskEvent {
  enum class Kind { start, done, error, stop, alloc };
  base::TimePoint time{};
  Kind kind = Kind::start;
  std::string task;  ///< name of the platform task
  std::optional<vehicle::VehicleId> vehicle;
  std::string detail;
  /// What it is about, for those who want more than its name (a mission's items). Shared as every task value is.
  std::shared_ptr<PlatformTask const> subject = {};
};
[[nodiscard]] std::string_view to_string(TaskEvent::Kind kind);

}  // namespace lapwing::tasks
