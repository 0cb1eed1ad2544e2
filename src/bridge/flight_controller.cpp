#include "bridge/flight_controller.hpp"

#include <charconv>

#include "mavlink/wire/modes.hpp"

namespace lapwing::bridge {

std::string FlightController::mode() const {
  if (!heartbeat) return {};
  return mavlink::mode_name(mavlink::autopilot_of(heartbeat->autopilot), mavlink::family_of(heartbeat->type),
                            heartbeat->custom_mode);
}

std::optional<std::uint32_t> FlightController::mode_number(std::string const& name) const {
  if (!heartbeat || name.empty()) return std::nullopt;
  auto const by_name =
      mavlink::mode_number(mavlink::autopilot_of(heartbeat->autopilot), mavlink::family_of(heartbeat->type), name);
  if (by_name) return by_name;
  std::uint32_t number = 0;
  auto const* const end = name.data() + name.size();
  auto const [stopped, error] = std::from_chars(name.data(), end, number);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return number;
}

}  // namespace lapwing::bridge
