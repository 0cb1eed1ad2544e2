#include "vehicle/modules.hpp"

namespace lapwing::vehicle {

std::string_view to_string(ModuleState state) {
  switch (state) {
    case ModuleState::unheard: return "unheard";
    case ModuleState::starting: return "starting";
    case ModuleState::ready: return "ready";
    case ModuleState::failed: return "failed";
    case ModuleState::silent: break;
  }
  return "silent";
}

std::string_view to_string(ModuleSeverity severity) {
  switch (severity) {
    case ModuleSeverity::notice: return "notice";
    case ModuleSeverity::degraded: return "degraded";
    case ModuleSeverity::critical: break;
  }
  return "critical";
}

}  // namespace lapwing::vehicle
