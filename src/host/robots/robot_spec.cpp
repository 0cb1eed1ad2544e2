#include "host/robots/robot_spec.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace lapwing::host {

namespace {

constexpr int most_robots = 8;
constexpr std::string_view ros_here = "ros2://";
constexpr std::string_view ros_in_the_network = "ros2-lan://";
constexpr std::string_view mavlink = "mavlink:";
constexpr std::string_view laser_mark = "laser=";
constexpr std::string_view radius_mark = "radius=";
constexpr double least_radius_m = 0.05;
constexpr std::array<std::pair<std::string_view, SimulatedRobots::Laser>, 4> lasers{
    {{"wide", SimulatedRobots::Laser::wide},
     {"half", SimulatedRobots::Laser::half},
     {"ring", SimulatedRobots::Laser::ring},
     {"none", SimulatedRobots::Laser::none}}};
constexpr int most_system_id = 254;  ///< 255 is a ground station's

std::unexpected<base::Error> refuse(std::string_view text, std::string_view why) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("--robot {}: {}", text, why),
                    "write sim:examples/buildings/office.toml, or a link: serial:///dev/ttyUSB0:115200@12.5,-3,90");
}

/// Numbers between commas, as many as are wanted; nothing where something else stands.
std::optional<std::array<double, 3>> three_numbers(std::string_view text) {
  std::array<double, 3> values{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), values[i]);
    if (error != std::errc() || !std::isfinite(values[i])) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    bool const is_last = i + 1 == values.size();
    if (is_last != text.empty() || (!is_last && text.front() != ',')) return std::nullopt;
    if (!is_last) text.remove_prefix(1);
  }
  return values;
}

/// What stands behind an address.
struct Extras {
  std::optional<std::string_view> laser = std::nullopt;
  std::optional<double> radius_m = std::nullopt;
};

/// Takes them off its end. Error: a radius that no robot has.
base::Result<Extras> take_extras(std::string_view text, std::string_view& address) {
  Extras extras;
  for (auto comma = address.rfind(','); comma != std::string_view::npos; comma = address.rfind(',')) {
    auto const word = address.substr(comma + 1);
    if (word.starts_with(laser_mark)) {
      extras.laser = word.substr(laser_mark.size());
    } else if (word.starts_with(radius_mark)) {
      auto const digits = word.substr(radius_mark.size());
      double radius_m = 0.0;
      auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), radius_m);
      bool const is_number = error == std::errc() && end == digits.data() + digits.size();
      if (!is_number || !(radius_m >= least_radius_m && radius_m <= robot::most_radius_m))
        return refuse(text, fmt::format("'{}' is no radius of a robot from {} to {} m", digits, least_radius_m,
                                        robot::most_radius_m));
      extras.radius_m = radius_m;
    } else {
      break;
    }
    address = address.substr(0, comma);
  }
  return extras;
}

base::Result<RobotRequest> simulated(std::string_view text, std::string_view file) {
  SimulatedRobots request;
  auto const extras = take_extras(text, file);
  if (!extras) return std::unexpected(extras.error());
  request.radius_m = extras->radius_m.value_or(request.radius_m);
  if (auto const named = extras->laser) {
    auto const found = std::ranges::find(lasers, *named, &std::pair<std::string_view, SimulatedRobots::Laser>::first);
    if (found == lasers.end())
      return refuse(text, fmt::format("'{}' is no laser of a simulated robot: write ,laser=none for sonars alone, "
                                      ",laser=ring for four single rangers, ,laser=half for half a circle ahead, "
                                      ",laser=wide for beams that edges cut in two, or nothing for a scanner",
                                      *named));
    request.laser = found->second;
  }
  auto const colon = file.rfind(':');
  if (colon != std::string_view::npos) {
    auto const digits = file.substr(colon + 1);
    auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), request.count);
    bool const is_count = error == std::errc() && end == digits.data() + digits.size();
    if (!is_count || request.count < 1 || request.count > most_robots)
      return refuse(text, fmt::format("'{}' is no number of robots from 1 to {}", digits, most_robots));
    file = file.substr(0, colon);
  }
  if (file.empty()) return refuse(text, "it names no building");
  request.file = file;
  return request;
}

base::Result<RobotRequest> on_ros(std::string_view text, std::string_view address, RosRobot request) {
  auto const slash = address.find('/');
  auto const digits = address.substr(0, slash);
  constexpr std::uint32_t most_domain = 101;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), request.domain);
  if (error != std::errc() || end != digits.data() + digits.size() || request.domain > most_domain)
    return refuse(text, fmt::format("'{}' is no domain of ROS 2 from 0 to {}", digits, most_domain));
  if (slash != std::string_view::npos && slash + 1 < address.size()) request.name_space = address.substr(slash);
  return request;
}

/// Error: as of a robot on ROS; nothing where it is no address of ROS.
std::optional<base::Result<RobotRequest>> by_ros(std::string_view text, std::string_view address, RosRobot request) {
  request.is_local = address.starts_with(ros_here);
  if (request.is_local) return on_ros(text, address.substr(ros_here.size()), std::move(request));
  if (!address.starts_with(ros_in_the_network)) return std::nullopt;
  return on_ros(text, address.substr(ros_in_the_network.size()), std::move(request));
}

base::Result<RobotRequest> over_mavlink(std::string_view text, std::string_view address,
                                        std::optional<std::string_view> laser_at, MavlinkRobot request) {
  auto const colon = address.find(':');
  auto const digits = address.substr(0, colon);
  int system_id = 0;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), system_id);
  bool const is_id = error == std::errc() && end == digits.data() + digits.size() && colon != std::string_view::npos;
  if (!is_id || system_id < 1 || system_id > most_system_id)
    return refuse(text, fmt::format("'{}' is no MAVLink system id from 1 to {}; write mavlink:1:udpin://0.0.0.0:14560",
                                    digits, most_system_id));
  request.system_id = static_cast<std::uint8_t>(system_id);
  address = address.substr(colon + 1);
  if (laser_at) {
    auto const laser = by_ros(text, *laser_at, {});
    if (!laser) return refuse(text, fmt::format("'{}' is no laser on ROS 2: write ,laser=ros2://0/robot1", *laser_at));
    if (!*laser) return std::unexpected(laser->error());
    auto const& ros = std::get<RosRobot>(**laser);
    request.laser = {.domain = ros.domain, .name_space = ros.name_space, .is_local = ros.is_local};
  }
  auto const url = link::parse_url(address);
  if (!url) return std::unexpected(url.error());
  request.url = *url;
  return request;
}

}  // namespace

base::Result<RobotRequest> parse_robot(std::string_view text) {
  constexpr std::string_view sim = "sim:";
  if (text.starts_with(sim)) return simulated(text, text.substr(sim.size()));
  LinkedRobot request;
  auto address = text;
  if (auto const at = text.rfind('@'); at != std::string_view::npos) {
    auto const numbers = three_numbers(text.substr(at + 1));
    if (!numbers) return refuse(text, fmt::format("'{}' is not EAST,NORTH,YAW", text.substr(at + 1)));
    auto const [east_m, north_m, yaw_deg] = *numbers;
    request.start = {{east_m, north_m}, yaw_deg * std::numbers::pi / 180.0};
    address = text.substr(0, at);
  }
  auto const extras = take_extras(text, address);
  if (!extras) return std::unexpected(extras.error());
  double const radius_m = extras->radius_m.value_or(robot::Limits{}.radius_m);
  if (address.starts_with(mavlink))
    return over_mavlink(text, address.substr(mavlink.size()), extras->laser,
                        {.url = {}, .radius_m = radius_m, .start = request.start});
  if (extras->laser) return refuse(text, "laser= is for simulated robots and MAVLink rovers");
  if (auto const ros = by_ros(text, address, {.radius_m = radius_m, .start = request.start})) return *ros;
  if (extras->radius_m) return refuse(text, "the board of such a robot says how large it is: leave radius= out");
  auto const url = link::parse_url(address);
  if (!url) return std::unexpected(url.error());
  request.url = *url;
  return request;
}

}  // namespace lapwing::host
