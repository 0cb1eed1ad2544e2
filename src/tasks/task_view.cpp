#include "tasks/task_view.hpp"

namespace lapwing::tasks {

std::string_view to_string(TaskState state) {
  switch (state) {
    case TaskState::waiting: return "waiting";
    case TaskState::running: return "running";
    case TaskState::done: return "done";
    case TaskState::failed: return "failed";
    case TaskState::stopped: return "stopped";
  }
  return "";
}

std::string_view to_string(TaskEvent::Kind kind) {
  switch (kind) {
    case TaskEvent::Kind::start: return "START";
    case TaskEvent::Kind::done: return "DONE";
    case TaskEvent::Kind::error: return "ERROR";
    case TaskEvent::Kind::stop: return "STOP";
    case TaskEvent::Kind::alloc: return "ALLOC";
  }
  return "";
}

}  // namespace lapwing::tasks
