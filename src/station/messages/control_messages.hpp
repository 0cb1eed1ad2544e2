#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "vehicle/control.hpp"

/// What operators say to vehicles, and what is told about it, as JSON: the part of protocol 1 that docs/reference/
/// station-messages.md calls "Commands".
namespace lapwing::station {

struct CommandVehicles {
  vehicle::VehicleCommand command;
  std::vector<vehicle::VehicleId> vehicles;
  bool takes_over = false;
};
struct StopAll {
  std::optional<vehicle::StopAction> action;
};
struct ReleaseStop {};
struct ChangeCommander {
  enum class What { request, yield, keep };
  What what = What::request;
  vehicle::VehicleId vehicle;
};

/// A client over HTTP that does not say who it is.
inline constexpr auto unnamed_client = "HTTP";

struct ControlRequest {
  std::variant<CommandVehicles, StopAll, ReleaseStop, ChangeCommander> what;
  vehicle::Commander by = {};  ///< as the client calls itself; empty when it does not say
};

/// "command", "emergency_stop", "release_emergency_stop", "request_control", "yield_control", "keep_control".
[[nodiscard]] bool is_control_request(std::string_view type);
/// Reads one; what is wrong with it is an error for people.
[[nodiscard]] base::Result<ControlRequest> parse_control_request(std::string_view type, std::string_view text);

/// Does what is asked. Gives the number of a command, 0 for anything else. Without `control` everything is refused.
base::Result<std::uint64_t> obey(vehicle::VehicleControl* control, ControlRequest request, vehicle::Commander by);

[[nodiscard]] std::string commands_message(std::deque<vehicle::CommandRecord> const& commands);
[[nodiscard]] std::string emergency_message(vehicle::EmergencyStop const& emergency);
/// One of the commands alone, as the answer to who gave it.
[[nodiscard]] std::string command_body(vehicle::CommandRecord const& command);

}  // namespace lapwing::station
