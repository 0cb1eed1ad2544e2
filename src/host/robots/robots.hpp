#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/eyes/looking_child.hpp"
#include "host/robots/robot_cameras.hpp"
#include "host/robots/robot_spec.hpp"
#include "robot/platform/robot_platform.hpp"
#include "robot/poi/eye.hpp"
#include "sim/building/building_run.hpp"

namespace lapwing::host {

/// A simulated building whose time passes with a loop's, and the robots in it.
struct SimulatedBuilding {
  std::unique_ptr<sim::building::Building> building;
  std::unique_ptr<sim::building::BuildingRun> run;
  std::vector<std::string> robots;                                       ///< ids, in the order of the building's
  geo::Transform<geo::SiteFrame, geo::FloorFrame> site_from_floor = {};  ///< where it stands
};

/// How often a robot of one of them ran into something; nothing for one that is in none.
[[nodiscard]] std::optional<int> collisions_of(std::vector<std::unique_ptr<SimulatedBuilding>> const& buildings,
                                               std::string const& robot);

/// A robot that is ready to join a platform.
struct RobotToAdd {
  robot::RobotSpec spec;
  std::unique_ptr<robot::Body> body;
  geo::Wgs84 anchor;                                    ///< of its site, where that is not on the map yet
  std::function<robot::Eyes(LookingChild&)> eyes = {};  ///< empty: it has no cameras; the child outlives them
};

/// The cameras of robots that are no simulated ones, and the program that takes their pictures.
struct CamerasOfRobots {
  std::vector<RobotCamera> cameras = {};
  LookingChild::Settings shooter = {};
};

/// The robots of some requests, called robot1, robot2 and so on, in the site `site` at `anchor`. Where a building says
/// where it is on the globe, its robots are placed by that. `buildings` gets the simulated ones and outlives the
/// robots. Errors: those of reading and making a building, and of opening a link; invalid_input for a camera of a robot
/// that there is not, or is simulated, and has its own.
[[nodiscard]] base::Result<std::vector<RobotToAdd>> make_robots(
    base::Loop& loop, std::vector<std::string> const& requests, std::string const& site, geo::Wgs84 const& anchor,
    std::uint64_t seed, CamerasOfRobots const& cameras, std::vector<std::unique_ptr<SimulatedBuilding>>& buildings,
    base::Logger const& log);

}  // namespace lapwing::host
