#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "geo/transform.hpp"
#include "link/url.hpp"
#include "robot/planner/way.hpp"
#include "robot/rover/laser_on_ros.hpp"

namespace lapwing::host {

/// Robots in a simulated building: `sim:examples/buildings/office.toml`, `sim:office.toml:2` for two;
/// `sim:office.toml,laser=none` for one that has its five sonars alone, `,laser=ring` for one with four single rangers,
/// `,laser=half` for one whose scanner sees half a circle ahead, `,laser=wide` for one whose beams have a width, so
/// that edges cut them in two; `,radius=0.3` for one of another size.
struct SimulatedRobots {
  enum class Laser { scanner, wide, half, ring, none };
  std::string file;
  int count = 1;
  Laser laser = Laser::scanner;
  double radius_m = robot::Limits{}.radius_m;
  friend bool operator==(SimulatedRobots const&, SimulatedRobots const&) = default;
};

/// A robot at the far end of a link: `serial:///dev/ttyUSB0:115200`, and where it stands when it is switched on:
/// `@EAST,NORTH,YAW` in metres from the site's anchor and degrees counterclockwise from east; none: at the anchor,
/// looking east.
struct LinkedRobot {
  link::Url url;
  geo::Pose<geo::SiteFrame> start = {};
  friend bool operator==(LinkedRobot const&, LinkedRobot const&) = default;
};

/// A robot that ROS 2 drives: `ros2://0/robot1`, domain and namespace, and where it stands as above; `ros2-lan://...`
/// when its ROS is not on this machine; `,radius=0.3` where it is no TurtleBot's size.
struct RosRobot {
  std::uint32_t domain = 0;
  std::string name_space = {};  ///< "/robot1"; empty: none
  bool is_local = true;
  double radius_m = robot::Limits{}.radius_m;
  geo::Pose<geo::SiteFrame> start = {};
  friend bool operator==(RosRobot const&, RosRobot const&) = default;
};

/// A robot whose carrier is a MAVLink rover: `mavlink:1:serial:///dev/ttyACM0:115200`, its system id and its link;
/// with `,laser=ros2://0/robot1` its ranges come from a laser on ROS 2, else over MAVLink too. Size and where it stands
/// as above.
struct MavlinkRobot {
  std::uint8_t system_id = 1;
  link::Url url;
  std::optional<robot::rover::LaserOnRos> laser = std::nullopt;
  double radius_m = robot::Limits{}.radius_m;
  geo::Pose<geo::SiteFrame> start = {};
  friend bool operator==(MavlinkRobot const&, MavlinkRobot const&) = default;
};

using RobotRequest = std::variant<SimulatedRobots, LinkedRobot, RosRobot, MavlinkRobot>;

/// What `--robot` says. Errors: invalid_input, with an example.
[[nodiscard]] base::Result<RobotRequest> parse_robot(std::string_view text);
inline constexpr auto robot_help =
    "A robot (may be repeated): sim:BUILDING.toml[:COUNT][,laser=wide|half|ring|none][,radius=M] in a simulated "
    "building, "
    "its link, serial:///dev/ttyUSB0:115200[@EAST,NORTH,YAW], metres and degrees in the site, "
    "ros2://DOMAIN[/NAMESPACE][,radius=M][@...], "
    "ros2-lan:// beyond this machine, or a MAVLink rover, "
    "mavlink:SYSTEM:LINK[,laser=ros2://DOMAIN[/NAMESPACE]][,radius=M][@...]";

}  // namespace lapwing::host
