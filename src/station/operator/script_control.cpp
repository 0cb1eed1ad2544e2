#include "station/operator/script_control.hpp"

namespace lapwing::station {

std::string_view to_string(ScriptState state) {
  switch (state) {
    case ScriptState::idle: return "idle";
    case ScriptState::running: return "running";
    case ScriptState::stopping: return "stopping";
    case ScriptState::stopped: return "stopped";
    case ScriptState::done: return "done";
    case ScriptState::failed: return "failed";
  }
  return "failed";
}

}  // namespace lapwing::station
