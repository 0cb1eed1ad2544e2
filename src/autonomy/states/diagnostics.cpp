#include "autonomy/states/diagnostics.hpp"

#include <iterator>

#include <fmt/format.h>

#include "base/text/printable.hpp"

namespace lapwing::autonomy {

namespace {

std::string number(std::optional<double> const& value) {
  return value ? fmt::format("{:.3f}", *value) : "unknown";
}

std::string place(std::optional<geo::Wgs84> const& value) {
  return value ? fmt::format("{:.7f} {:.7f}", value->lat_deg(), value->lon_deg()) : "unknown";
}

std::string flight_lines(FlightController const& flight) {
  std::string text;
  auto const out = std::back_inserter(text);
  fmt::format_to(out, "silence_s: {:.3f}\nmode: {}\narmed: {}\nprearm_ok: {}\ncritical: {}\n",
                 base::to_seconds(flight.silence), base::printable(flight.mode), flight.is_armed, flight.prearm_ok,
                 flight.is_critical);
  fmt::format_to(out, "gps_fix: {}\nrelative_altitude_m: {}\nposition: {}\nhome: {}\nbattery: {}\n", flight.gps_fix,
                 number(flight.relative_alt_m), place(flight.position), place(flight.home), number(flight.battery));
  if (flight.local)
    fmt::format_to(out, "local_m: {:.2f} {:.2f} {:.2f}\n", flight.local->x(), flight.local->y(), flight.local->z());
  return text;
}

}  // namespace

std::string diagnostics_text(Situation const& s) {
  auto text = fmt::format("reason: {}\nat_s: {:.3f}\nin_state_s: {:.3f}\nreserve: {:.3f}\n", s.memory.reason,
                          base::to_seconds(s.now.time_since_epoch()), base::to_seconds(s.now - s.memory.entered),
                          reserve_here(s));
  auto const out = std::back_inserter(text);
  fmt::format_to(out, "operator: {}, silent for {:.3f} s\n", s.told.link.is_up ? "up" : "down",
                 base::to_seconds(s.told.link.silence));
  text += s.told.flight ? flight_lines(*s.told.flight) : "flight controller: never heard\n";
  for (auto const& process : s.told.processes)
    fmt::format_to(out, "process {}: {}, silent for {} s {}\n", process.name, process.is_well ? "well" : "failed",
                   process.silence ? fmt::format("{:.3f}", base::to_seconds(*process.silence)) : "ever",
                   base::printable(process.words));
  return text;
}

}  // namespace lapwing::autonomy
