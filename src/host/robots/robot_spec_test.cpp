#include "host/robots/robot_spec.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

TEST(RobotSpec, NamesASimulatedBuilding) {
  EXPECT_EQ(std::get<SimulatedRobots>(*parse_robot("sim:a/office.toml")), (SimulatedRobots{"a/office.toml", 1}));
  EXPECT_EQ(std::get<SimulatedRobots>(*parse_robot("sim:office.toml:3")), (SimulatedRobots{"office.toml", 3}));
}

TEST(RobotSpec, NamesWhatTheRobotsInASimulatedBuildingMeasureBy) {
  using Laser = SimulatedRobots::Laser;
  EXPECT_EQ(std::get<SimulatedRobots>(*parse_robot("sim:office.toml,laser=none")),
            (SimulatedRobots{"office.toml", 1, Laser::none}));
  EXPECT_EQ(std::get<SimulatedRobots>(*parse_robot("sim:office.toml:2,laser=ring")),
            (SimulatedRobots{"office.toml", 2, Laser::ring}));
  EXPECT_EQ(std::get<SimulatedRobots>(*parse_robot("sim:office.toml,laser=half")),
            (SimulatedRobots{"office.toml", 1, Laser::half}));
  EXPECT_EQ(std::get<SimulatedRobots>(*parse_robot("sim:office.toml,laser=wide")),
            (SimulatedRobots{"office.toml", 1, Laser::wide}));
}

TEST(RobotSpec, NamesALinkAndWhereTheRobotStands) {
  auto const plain = std::get<LinkedRobot>(*parse_robot("serial:///dev/ttyUSB0:115200"));
  EXPECT_EQ(plain.url, (link::Url{link::Transport::serial, "/dev/ttyUSB0", 115200}));
  EXPECT_EQ(plain.start, geo::Pose<geo::SiteFrame>{});
  auto const placed = std::get<LinkedRobot>(*parse_robot("tcpout://127.0.0.1:5770@12.5,-3,90"));
  EXPECT_EQ(placed.url.port_or_baud, 5770u);
  EXPECT_EQ(placed.start.position, geo::Point<geo::SiteFrame>(12.5, -3.0));
  EXPECT_NEAR(placed.start.yaw_rad, std::numbers::pi / 2.0, 1e-12);
}

TEST(RobotSpec, NamesARobotOnRos) {
  EXPECT_EQ(std::get<RosRobot>(*parse_robot("ros2://0")), (RosRobot{.domain = 0, .name_space = ""}));
  EXPECT_EQ(std::get<RosRobot>(*parse_robot("ros2://7/")), (RosRobot{.domain = 7, .name_space = ""}));
  auto const placed = std::get<RosRobot>(*parse_robot("ros2://42/floor/robot1@1,2,0"));
  EXPECT_EQ(placed.name_space, "/floor/robot1");
  EXPECT_EQ(placed.start.position, geo::Point<geo::SiteFrame>(1.0, 2.0));
  EXPECT_TRUE(placed.is_local);
  EXPECT_FALSE(std::get<RosRobot>(*parse_robot("ros2-lan://0/robot1")).is_local);
}

TEST(RobotSpec, NamesAMavlinkRover) {
  auto const plain = std::get<MavlinkRobot>(*parse_robot("mavlink:3:serial:///dev/ttyACM0:115200"));
  EXPECT_EQ(plain.system_id, 3);
  EXPECT_EQ(plain.url, (link::Url{link::Transport::serial, "/dev/ttyACM0", 115200}));
  EXPECT_FALSE(plain.laser);
  auto const whole =
      std::get<MavlinkRobot>(*parse_robot("mavlink:1:udpin://0.0.0.0:14560,laser=ros2-lan://7/r@1,2,90"));
  EXPECT_EQ(whole.url.port_or_baud, 14560u);
  EXPECT_EQ(whole.laser, (robot::rover::LaserOnRos{.domain = 7, .name_space = "/r", .is_local = false}));
  EXPECT_EQ(whole.start.position, geo::Point<geo::SiteFrame>(1.0, 2.0));
}

TEST(RobotSpec, NamesHowLargeARobotIs) {
  EXPECT_EQ(std::get<SimulatedRobots>(*parse_robot("sim:a,b.toml:2,radius=0.3,laser=ring")),
            (SimulatedRobots{"a,b.toml", 2, SimulatedRobots::Laser::ring, 0.3}));
  EXPECT_EQ(std::get<RosRobot>(*parse_robot("ros2://0/robot1,radius=0.25@1,2,0")),
            (RosRobot{.name_space = "/robot1", .radius_m = 0.25, .start = {{1.0, 2.0}, 0.0}}));
  auto const rover = std::get<MavlinkRobot>(*parse_robot("mavlink:1:udpin://0.0.0.0:14560,radius=0.4,laser=ros2://7"));
  EXPECT_EQ(rover.radius_m, 0.4);
  EXPECT_EQ(rover.laser, (robot::rover::LaserOnRos{.domain = 7, .name_space = "", .is_local = true}));
  EXPECT_EQ(std::get<RosRobot>(*parse_robot("ros2://0")).radius_m, 0.18);
}

TEST(RobotSpec, SaysWhatIsWrong) {
  auto const wrong = [](std::string_view text) { return parse_robot(text).error().message; };
  EXPECT_EQ(wrong("sim:"), "--robot sim:: it names no building");
  EXPECT_EQ(wrong("sim:a.toml:0"), "--robot sim:a.toml:0: '0' is no number of robots from 1 to 8");
  EXPECT_EQ(wrong("sim:a.toml:x"), "--robot sim:a.toml:x: 'x' is no number of robots from 1 to 8");
  EXPECT_EQ(wrong("sim:a.toml,laser=red"),
            "--robot sim:a.toml,laser=red: 'red' is no laser of a simulated robot: write ,laser=none for sonars alone, "
            ",laser=ring for four single rangers, ,laser=half for half a circle ahead, ,laser=wide for beams that "
            "edges cut in two, or nothing for a scanner");
  EXPECT_EQ(wrong("serial:///dev/ttyUSB0:115200@1,2"),
            "--robot serial:///dev/ttyUSB0:115200@1,2: '1,2' is not EAST,NORTH,YAW");
  EXPECT_EQ(wrong("serial:///dev/ttyUSB0:115200@1,2,3,4"),
            "--robot serial:///dev/ttyUSB0:115200@1,2,3,4: '1,2,3,4' is not EAST,NORTH,YAW");
  EXPECT_EQ(wrong("serial:///dev/ttyUSB0:115200@1,nan,3"),
            "--robot serial:///dev/ttyUSB0:115200@1,nan,3: '1,nan,3' is not EAST,NORTH,YAW");
  EXPECT_EQ(wrong("ros2://"), "--robot ros2://: '' is no domain of ROS 2 from 0 to 101");
  EXPECT_EQ(wrong("ros2://102/r"), "--robot ros2://102/r: '102' is no domain of ROS 2 from 0 to 101");
  EXPECT_EQ(wrong("mavlink:udpin://0.0.0.0:14560"),
            "--robot mavlink:udpin://0.0.0.0:14560: 'udpin' is no MAVLink system id from 1 to 254; write "
            "mavlink:1:udpin://0.0.0.0:14560");
  EXPECT_EQ(wrong("mavlink:255:udpin://0.0.0.0:14560"),
            "--robot mavlink:255:udpin://0.0.0.0:14560: '255' is no MAVLink system id from 1 to 254; write "
            "mavlink:1:udpin://0.0.0.0:14560");
  EXPECT_EQ(wrong("mavlink:1:udpin://0.0.0.0:14560,laser=/dev/ttyUSB0"),
            "--robot mavlink:1:udpin://0.0.0.0:14560,laser=/dev/ttyUSB0: '/dev/ttyUSB0' is no laser on ROS 2: write "
            ",laser=ros2://0/robot1");
  EXPECT_EQ(wrong("ros2://0,radius=5"), "--robot ros2://0,radius=5: '5' is no radius of a robot from 0.05 to 1 m");
  EXPECT_EQ(wrong("sim:a.toml,radius=nan"),
            "--robot sim:a.toml,radius=nan: 'nan' is no radius of a robot from 0.05 to 1 m");
  EXPECT_EQ(wrong("serial:///dev/ttyUSB0:115200,radius=0.3"),
            "--robot serial:///dev/ttyUSB0:115200,radius=0.3: the board of such a robot says how large it is: leave "
            "radius= out");
  EXPECT_EQ(wrong("ros2://0,laser=ring"),
            "--robot ros2://0,laser=ring: laser= is for simulated robots and MAVLink rovers");
  EXPECT_FALSE(parse_robot("mavlink:1:"));
  EXPECT_FALSE(parse_robot("mavlink:1:udpin://0.0.0.0:14560,laser=ros2://500"));
  EXPECT_FALSE(parse_robot("office"));
}

}  // namespace
}  // namespace lapwing::host
