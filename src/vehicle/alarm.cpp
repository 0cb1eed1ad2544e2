#include "vehicle/alarm.hpp"

namespace lapwing::vehicle {

std::string_view to_string(AlarmKind kind) {
  switch (kind) {
    case AlarmKind::silent: return "silent";
    case AlarmKind::lost: return "lost";
    case AlarmKind::conflict: return "conflict";
    case AlarmKind::battery_low: return "battery_low";
    case AlarmKind::battery_critical: return "battery_critical";
    case AlarmKind::failsafe: return "failsafe";
    case AlarmKind::fence: return "fence";
    case AlarmKind::foreign_mode: return "foreign_mode";
    case AlarmKind::left_armed: return "left_armed";
  }
  return "silent";
}

std::string_view words_for_many(AlarmKind kind) {
  switch (kind) {
    case AlarmKind::silent: return "silent";
    case AlarmKind::lost: return "lost";
    case AlarmKind::conflict: return "with an id that another vehicle uses, too";
    case AlarmKind::battery_low: return "with a low battery";
    case AlarmKind::battery_critical: return "with a nearly empty battery";
    case AlarmKind::failsafe: return "in a failsafe";
    case AlarmKind::fence: return "beyond their fence";
    case AlarmKind::foreign_mode: return "in a mode not asked for here";
    case AlarmKind::left_armed: return "left armed";
  }
  return "silent";
}

std::string_view to_string(Severity severity) {
  return severity == Severity::critical ? "critical" : "warning";
}

}  // namespace lapwing::vehicle
