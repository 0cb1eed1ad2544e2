#include "tasks/event_json.hpp"

#include <cmath>

#include <fmt/format.h>

namespace lapwing::tasks {
namespace {

std::string quoted(std::string_view text) {
  std::string json = "\"";
  for (char const c : text) {
    if (c == '"' || c == '\\') {
      json += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      json += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      json += c;
    }
  }
  return json + '"';
}

}  // namespace

std::string to_json_line(TaskEvent const& event, std::string_view more) {
  double const t = std::round(base::to_seconds(event.time.time_since_epoch()) * 1e3) / 1e3;
  auto line = fmt::format(R"({{"t":{},"event":{},"task":{})", t, quoted(to_string(event.kind)), quoted(event.task));
  if (event.vehicle) line += fmt::format(R"(,"vehicle":{})", quoted(event.vehicle->text));
  if (!event.detail.empty()) line += fmt::format(R"(,"detail":{})", quoted(event.detail));
  if (!more.empty()) line += fmt::format(",{}", more);
  return line + "}";
}

}  // namespace lapwing::tasks
