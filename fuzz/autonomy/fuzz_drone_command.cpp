// What an operator sends to a drone and a drone to its operator, and what the drone's own settings may hold. A command
// that is read goes to a drone that hovers, which answers it; whatever it asks for afterwards is finite.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "autonomy/operator/command_text.hpp"
#include "autonomy/operator/map_follower.hpp"
#include "autonomy/operator/map_request.hpp"
#include "autonomy/operator/report_reader.hpp"
#include "autonomy/operator/report_text.hpp"
#include "autonomy/settings/heights_text.hpp"
#include "autonomy/states/machine.hpp"
#include "require.hpp"

using namespace lapwing;
using namespace lapwing::autonomy;

namespace {

Told hovering() {
  auto const home = geo::Wgs84::from_degrees(43, -79, 100);
  Told told;
  told.link = {.is_up = true, .silence = {}};
  told.flight = FlightController{.mode = "GUIDED",
                                 .is_armed = true,
                                 .gps_fix = gps_fix_3d,
                                 .relative_alt_m = 10.0,
                                 .position = home,
                                 .local = geo::Point3<ArmingFrame>(0, 0, 10),
                                 .home = home,
                                 .battery = 0.9};
  return told;
}

void require_sound(Said const& said) {
  for (auto const& request : said.requests) {
    if (auto const* const local = std::get_if<request::LocalSetpoint>(&request))
      fuzz::require(local->place.is_finite());
    if (auto const* const global = std::get_if<request::GlobalSetpoint>(&request))
      fuzz::require(std::abs(global->place.lat_rad) < 1.6 && std::abs(global->place.lon_rad) < 3.2);
  }
  for (auto const& text : said.error_log) fuzz::require(error_log_text(text).size() < 8 * longest_error_log);
}

void obey(Command const& command) {
  Machine machine;
  auto told = hovering();
  base::TimePoint now{};
  (void)machine.step(told, now);
  told.commands = {command};
  for (int i = 0; i < 3; ++i) {
    now += std::chrono::milliseconds(50);
    require_sound(machine.step(told, now));
    told.commands.clear();
  }
}

/// A line each: what a drone says of its map, as an operator's program puts it together.
void follow(std::string_view lines) {
  MapFollower follower;
  while (!lines.empty()) {
    auto const end = std::min(lines.find('\n'), lines.size());
    auto report = parse_report(lines.substr(0, end));
    lines.remove_prefix(std::min(end + 1, lines.size()));
    if (!report) continue;
    if (auto* const whole = std::get_if<report::Map>(&*report)) follower.take(std::move(*whole));
    if (auto const* const changes = std::get_if<report::MapChanges>(&*report)) follower.take(*changes);
    fuzz::require(!follower.map() || is_sound(*follower.map()));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  if (auto const command = parse_command(text))
    obey(*command);
  else
    fuzz::require(error_log_text(command.error()).size() < 8 * longest_error_log);
  if (auto const report = parse_report(text))
    if (auto const* const heartbeat = std::get_if<report::Heartbeat>(&*report); heartbeat && heartbeat->map)
      fuzz::require(heartbeat->map->cells.size() == std::size_t{heartbeat->map->columns} * heartbeat->map->rows);
  follow(text);
  if (auto const request = parse_map_request(text); request && !*request)
    fuzz::require(error_log_text(request->error()).size() < 8 * longest_error_log);
  if (auto const heights = parse_heights("settings", text)) fuzz::require(!heights_fault(*heights));
  return 0;
}
