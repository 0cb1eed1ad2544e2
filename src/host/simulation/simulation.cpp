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

/// "5,127": the wind that moves the air by so much.
std::string as_blown(double north_m_s, double east_m_s) {
  auto const from_deg = std::llround(std::atan2(-east_m_s, -north_m_s) * 180.0 / std::numbers::pi);
  return fmt::format("{:.3g},{}", std::hypot(north_m_s, east_m_s), (from_deg + 360) % 360);
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

base::Result<> set_wind(sim::WorldOptions& world, std::string const& text) {
  constexpr double strongest_m_s = 50.0;
  if (text.empty()) return {};
  auto const read = numbers(text);
  auto const count = read ? read->size() : 0;
  double const speed = count > 0 ? (*read)[0] : 0.0;
  double const from_deg = count > 1 ? (*read)[1] : 0.0;
  double const gust = count > 2 ? (*read)[2] : 0.0;
  auto const is_strength = [](double value) { return value >= 0.0 && value <= strongest_m_s; };
  bool const has_sense = count == 3 || speed > 0.0 || from_deg == 0.0;
  bool const is_wind = (count == 2 || count == 3) && is_strength(speed) && is_strength(gust) && from_deg >= 0.0 &&
                       from_deg <= 360.0 && has_sense;
  if (!is_wind) {
    std::string hint = "write SPEED,FROM or SPEED,FROM,GUST in m/s (up to 50) and degrees: 6,270 or 6,270,2";
    if (count == 2) hint += fmt::format("; NORTH,EAST of earlier versions is {} now", as_blown(speed, from_deg));
    return base::fail(base::ErrorKind::invalid_input, fmt::format("'{}' is no wind", text), std::move(hint));
  }
  double const from = from_deg * std::numbers::pi / 180.0;
  world.wind_m_s = {-speed * std::cos(from), -speed * std::sin(from), 0.0};
  world.gust_m_s = gust;
  return {};
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
