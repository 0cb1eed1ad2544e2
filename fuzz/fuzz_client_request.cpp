// Any text that a browser may send over the WebSocket or post as a script, and the answers that quote it.
#include <cstdint>
#include <string>
#include <variant>

#include "require.hpp"
#include "station/messages/client_request.hpp"
#include "station/messages/messages.hpp"

using namespace lapwing;

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string const text(data, data + size);
  auto const request = station::parse_client_request(text);
  if (request) {
    fuzz::require(!station::accepted_message(request->id).empty());
    if (auto const* subscribe = std::get_if<station::Subscribe>(&request->what)) {
      fuzz::require(subscribe->feeds.size() <= 100 && subscribe->revisions.size() <= 100);
      for (auto const& name : subscribe->feeds) fuzz::require(name.size() <= 100);
    }
  } else {
    fuzz::require(!request.error().message.empty());
    fuzz::require(!station::refused_message("1", {request.error(), {}}).empty());
  }
  for (auto const* type : {"command", "emergency_stop", "keep_control", "acknowledge_alarms"}) {
    auto const body = station::parse_request_body(type, text);
    fuzz::require(body || !body.error().message.empty());
  }
  auto const body = station::parse_request_body("start_script", text);
  if (!body) {
    fuzz::require(!station::start_failure_body(422, "wrong", {body.error(), {}}).empty());
  } else {
    auto const& start = std::get<station::StartScript>(*body);
    station::ScriptStatus const status{.name = start.name, .source = start.source, .message = {}, .diagnostics = {}};
    fuzz::require(!station::script_message(status).empty());
  }
  return 0;
}
