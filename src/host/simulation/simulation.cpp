#include "host/simulation/simulation.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "link/byte_link.hpp"

namespace lapwing::host {

namespace {

/// Numbers between commas, at most four; nothing where something else stands.
std::optional<std::vector<double>> numbers(std::string const& text) {
  constexpr std::size_t most = 4;
  std::vector<double> values;
  for (std::size_t at = 0; at <= text.size();) {
    auto const comma = std::min(text.find(',', at), text.size());
    auto const part = text.substr(at, comma - at);
    char* end = nullptr;
    double const value = std::strtod(part.c_str(), &end);
    if (values.size() == most || part.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
    values.push_back(value);
    at = comma + 1;
  }
  return values;
}

}  // namespace

base::Result<HomePlace> parse_home(std::string const& text) {
  auto const refuse = [&] {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("'{}' is not a place", text),
                      "write LAT,LON,ALT or LAT,LON,ALT,HEADING in degrees and metres: 41.1780,-8.5980,90");
  };
  auto const read = numbers(text);
  if (!read) return refuse();
  auto const count = read->size();
  std::array<double, 4> values{};
  std::ranges::copy(*read, values.begin());
  if (count < 3 || std::abs(values[0]) > 90.0 || std::abs(values[1]) > 180.0) return refuse();
  return HomePlace{geo::Wgs84::from_degrees(values[0], values[1], values[2]), values[3] * std::numbers::pi / 180.0};
}

base::Result<SimulatedWind> parse_wind(std::string const& text) {
  constexpr double strongest_m_s = 50.0;
  auto const read = numbers(text);
  bool const is_wind = read && (read->size() == 2 || read->size() == 3) && read->front() >= 0.0 &&
                       read->front() <= strongest_m_s && read->back() >= 0.0 && (*read)[1] <= 360.0;
  if (!is_wind || (read->size() == 3 && read->back() > strongest_m_s)) {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("'{}' is no wind", text),
                      "write SPEED,FROM or SPEED,FROM,GUST in m/s (up to 50) and degrees: 6,270 or 6,270,2");
  }
  double const from = (*read)[1] * std::numbers::pi / 180.0;
  SimulatedWind wind{.air_m_s = {-read->front() * std::cos(from), -read->front() * std::sin(from), 0.0}};
  if (read->size() == 3) wind.gust_m_s = read->back();
  return wind;
}

base::Result<std::unique_ptr<sim::World>> start_simulation(Ground& ground, sim::WorldOptions options,
                                                           base::Logger log) {
  constexpr std::uint32_t first_port = 14550;
  constexpr std::uint32_t last_port = 14650;
  for (auto port = first_port;; ++port) {
    auto link = link::open(ground.loop, {link::Transport::udp_in, "127.0.0.1", port});
    if (!link && port == last_port) return std::unexpected(link.error());
    if (!link) continue;
    ground.connection.add_link(std::move(*link));
    options.out = {link::Transport::udp_out, "127.0.0.1", port};
    break;
  }
  auto world = std::make_unique<sim::World>(ground.loop, std::move(options), log.named("sim"));
  if (auto started = world->start(); !started) return std::unexpected(started.error());
  return world;
}

base::Result<> place(sim::WorldOptions& world, std::string const& said,
                     std::optional<geo::Wgs84> const& home_of_script) {
  if (said.empty()) {
    world.home = home_of_script.value_or(world.home);
    return {};
  }
  auto const home = parse_home(said);
  if (!home) return std::unexpected(home.error());
  world.home = home->place;
  world.heading_rad = home->heading_rad;
  return {};
}

base::Loop::Pace pace_for(double speedup, std::optional<std::uint64_t> seed) {
  constexpr std::chrono::sys_days start = std::chrono::year{2000} / std::chrono::January / 1;
  auto const begins_at = seed ? std::optional<base::UtcTime>(start) : std::nullopt;
  if (speedup == 0.0) return {.speedup = 1.0, .unpaced = true, .begins_at = begins_at};
  return {.speedup = speedup, .unpaced = false, .begins_at = begins_at};
}

}  // namespace lapwing::host
