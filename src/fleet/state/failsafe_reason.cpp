#include "fleet/state/failsafe_reason.hpp"

#include <algorithm>
#include <ranges>

#include <fmt/core.h>

namespace lapwing::fleet {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration is_recent = 5s;

bool has(std::string_view text, std::string_view part) {
  return text.contains(part);
}

}  // namespace

bool tells_failsafe(std::string_view text) {
  bool const is_about_arming = text.starts_with("PreArm") || text.starts_with("Arm:");
  bool const is_over = has(text, "leared") || has(text, "eactivated") || text.ends_with("off") || text.ends_with("Off");
  if (is_about_arming || is_over) return false;
  // "Fence Breached" of ArduPilot 4.6, "Circle fence breached" of 4.7. Only its copters say "Battery Failsafe".
  bool const fence = has(text, "fence breached") || has(text, "Fence Breached") || has(text, "Fence breached");
  bool const battery = text.starts_with("Battery ") && (has(text, " is low") || has(text, " is critical"));
  return has(text, "ailsafe") || fence || battery;
}

std::string recent_failsafe(vehicle::VehicleState const& state, base::TimePoint now,
                            std::optional<base::TimePoint> fence_breached) {
  for (auto const& text : std::views::reverse(state.recent_texts))
    if (text.heard + is_recent >= now && tells_failsafe(text.text)) return text.text;
  auto const& fence = state.mission.fence;
  if (!fence.value) return {};
  bool const is_breached = fence.value->is_breached && fence.heard + is_recent >= now;
  bool const was_breached = fence_breached && *fence_breached + is_recent >= now;
  if (!is_breached && !was_breached) return {};
  return fence.value->type.empty() ? "fence breached" : fmt::format("fence breached: {}", fence.value->type);
}

}  // namespace lapwing::fleet
