#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "vehicle/control.hpp"

/// What clients ask of the station, over WebSocket and HTTP alike: protocol 1, as docs/reference/station-messages.md
/// describes it.
namespace lapwing::station {

struct StartScript {
  std::string name = "script";
  std::string source;
};
struct StopScript {};
struct Ping {};
struct Subscribe {
  std::vector<std::string> feeds;
  std::string run = {};  ///< of which the revisions are
  std::map<std::string, std::uint64_t> revisions = {};
};

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
struct ControlRequest {
  std::variant<CommandVehicles, StopAll, ReleaseStop, ChangeCommander> what;
  vehicle::Commander by = {};  ///< as the client calls itself; empty when it does not say
};

struct AcknowledgeAlarms {
  std::vector<std::uint64_t> numbers;
  vehicle::Commander by = {};  ///< as in ControlRequest
};

/// A client over HTTP that does not say who it is.
inline constexpr auto unnamed_client = "HTTP";

struct ClientRequest {
  using What = std::variant<Ping, StartScript, StopScript, Subscribe, ControlRequest, AcknowledgeAlarms>;

  std::string id;  ///< chosen by the client, comes back in the answer; may be empty
  What what;
};

/// Reads what a client sent over its WebSocket, which says itself what it is; says what is wrong with it.
[[nodiscard]] base::Result<ClientRequest> parse_client_request(std::string_view text);
/// Reads the body of an HTTP request, which is that type of request by its path.
[[nodiscard]] base::Result<ClientRequest::What> parse_request_body(std::string_view type, std::string_view body);

}  // namespace lapwing::station
