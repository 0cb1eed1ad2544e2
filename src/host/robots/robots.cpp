#include "host/robots/robots.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "host/eyes/camera_sources.hpp"
#include "host/eyes/simulated_eyes.hpp"
#include "host/files/files.hpp"
#include "robot/platform/linked_body.hpp"
#include "robot/ros/ros_body.hpp"
#include "robot/rover/rover_body.hpp"
#include "sim/building/plan/building_file.hpp"

namespace lapwing::host {

namespace building = sim::building;

namespace {

building::RobotSettings settings_of(SimulatedRobots const& request) {
  auto settings = building::RobotSettings::of_radius(request.radius_m);
  if (request.laser == SimulatedRobots::Laser::wide) settings.laser = building::wide_scanner();
  if (request.laser == SimulatedRobots::Laser::half) settings.laser = building::half_scanner(0.6 * request.radius_m);
  if (request.laser == SimulatedRobots::Laser::ring) settings.laser = building::tof_ring();
  if (request.laser == SimulatedRobots::Laser::none) settings.laser.beams = 0;
  return settings;
}

/// Makes robots one after the other, and counts them.
class Maker {
 public:
  Maker(base::Loop& loop, std::string site, geo::Wgs84 const& anchor, std::uint64_t seed,
        CamerasOfRobots const& cameras, std::vector<std::unique_ptr<SimulatedBuilding>>& buildings,
        base::Logger const& log)
      : loop_(loop),
        site_(std::move(site)),
        anchor_(anchor),
        seed_(seed),
        cameras_(cameras),
        buildings_(buildings),
        log_(log) {}

  base::Result<> operator()(SimulatedRobots const& request) {
    auto text = read_script(request.file);
    if (!text) return std::unexpected(text.error());
    auto plan = building::building_of(request.file, *std::move(text));
    if (!plan) return std::unexpected(plan.error());
    auto made =
        building::Building::make(*plan, {.seed = seed_, .robots = request.count, .robot = settings_of(request)});
    if (!made) return std::unexpected(made.error());
    auto simulated = std::make_unique<SimulatedBuilding>();
    simulated->building = *std::move(made);
    simulated->run = std::make_unique<building::BuildingRun>(loop_, *simulated->building);
    simulated->site_from_floor = site_from_floor(*plan);
    for (std::size_t i = 0; i < simulated->building->robot_count(); ++i) {
      auto const start = simulated->building->robot(i).body().pose();
      auto spec = next_spec(simulated->site_from_floor * start);
      if (request.laser == SimulatedRobots::Laser::none) spec.payload = {"Sonar"};
      spec.payload.emplace_back(robot::camera_payload);
      simulated->robots.push_back(spec.id);
      add(std::move(spec), simulated->run->connect(i));
      robots_.back().eyes = [this_loop = &loop_, in = simulated->building.get(), i](LookingChild& child) {
        return simulated_eyes(*this_loop, *in, i, child);
      };
    }
    buildings_.push_back(std::move(simulated));
    return {};
  }

  base::Result<> operator()(LinkedRobot const& request) {
    auto link = link::open(loop_, request.url);
    if (!link) return std::unexpected(link.error());
    add(next_spec(request.start), *std::move(link));
    return add_cameras({});
  }

  base::Result<> operator()(RosRobot const& request) {
    auto spec = next_spec(request.start);
    auto body = robot::ros::RosBody::open(loop_,
                                          {.domain = request.domain,
                                           .name_space = request.name_space,
                                           .is_local = request.is_local,
                                           .radius_m = request.radius_m},
                                          log_.named(spec.id));
    if (!body) return std::unexpected(body.error());
    robots_.push_back({.spec = std::move(spec), .body = *std::move(body), .anchor = anchor_});
    return add_cameras(
        [this, request] { return bus::Bus::open(loop_, {.domain = request.domain, .is_local = request.is_local}); });
  }

  base::Result<> operator()(MavlinkRobot const& request) {
    auto link = link::open(loop_, request.url);
    if (!link) return std::unexpected(link.error());
    auto spec = next_spec(request.start);
    auto body = std::make_unique<robot::rover::RoverBody>(
        loop_, *std::move(link),
        robot::rover::RoverBodyOptions{.system_id = request.system_id, .origin = anchor_, .radius_m = request.radius_m},
        log_.named(spec.id));
    if (request.laser)
      if (auto used = body->use(*request.laser); !used) return used;
    robots_.push_back({.spec = std::move(spec), .body = std::move(body), .anchor = anchor_});
    OpenBus open_bus;
    if (request.laser)
      open_bus = [this, laser = *request.laser] {
        return bus::Bus::open(loop_, {.domain = laser.domain, .is_local = laser.is_local});
      };
    return add_cameras(open_bus);
  }

  [[nodiscard]] std::vector<RobotToAdd> take() { return std::move(robots_); }

 private:
  /// Of the robot that was added last.
  base::Result<> add_cameras(OpenBus const& open_bus) {
    auto& robot = robots_.back();
    auto const log = log_.named(robot.spec.id);
    auto sources = camera_sources(loop_, cameras_.cameras, robot.spec.id, cameras_.shooter, open_bus, log);
    if (!sources) return std::unexpected(sources.error());
    if (sources->for_tags.empty()) return {};
    robot.spec.payload.emplace_back(robot::camera_payload);
    robot.eyes = [loop = &loop_, sources = *std::move(sources)](LookingChild& child) {
      return eyes_with(*loop, sources.for_tags, sources.ahead, child);
    };
    return {};
  }
  [[nodiscard]] robot::RobotSpec next_spec(geo::Pose<geo::SiteFrame> const& start) const {
    robot::RobotSpec spec;
    spec.id = fmt::format("robot{}", robots_.size() + 1);
    spec.name = fmt::format("robot {}", robots_.size() + 1);
    spec.site = site_;
    spec.start = start;
    return spec;
  }
  /// Where the building lies in our site: by its own anchor, if it says where on the globe that is.
  [[nodiscard]] geo::Transform<geo::SiteFrame, geo::FloorFrame> site_from_floor(
      building::BuildingPlan const& plan) const {
    auto const ours = geo::Site::make("site", anchor_);
    if (!plan.anchor || !ours) return plan.site_from_floor;
    auto const there = ours->point_of(*plan.anchor);
    auto const origin = plan.site_from_floor.origin() + geo::Vector<geo::SiteFrame>(there.x(), there.y());
    return {origin, plan.site_from_floor.yaw_rad()};
  }
  void add(robot::RobotSpec spec, std::unique_ptr<link::ByteLink> link) {
    auto log = log_.named(spec.id);
    robots_.push_back({.spec = std::move(spec),
                       .body = std::make_unique<robot::LinkedBody>(loop_, std::move(link), std::move(log)),
                       .anchor = anchor_});
  }

  base::Loop& loop_;
  std::string site_;
  geo::Wgs84 anchor_;
  std::uint64_t seed_;
  CamerasOfRobots const& cameras_;
  std::vector<std::unique_ptr<SimulatedBuilding>>& buildings_;
  base::Logger const& log_;
  std::vector<RobotToAdd> robots_;
};

/// A camera whose robot is not there, or sees otherwise, would be forgotten without a word.
base::Result<> check_cameras(std::vector<RobotCamera> const& cameras, std::vector<RobotToAdd> const& robots,
                             std::vector<std::unique_ptr<SimulatedBuilding>> const& buildings) {
  for (auto const& camera : cameras) {
    auto const is_its = [&](RobotToAdd const& robot) { return robot.spec.id == camera.robot; };
    if (std::ranges::none_of(robots, is_its))
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("there is no robot '{}' for the camera {}", camera.robot, camera.from),
                        "robots are called robot1, robot2 and so on, in the order in which they are named");
    if (collisions_of(buildings, camera.robot))
      return base::fail(base::ErrorKind::invalid_input,
                        fmt::format("{} is simulated and has its own cameras", camera.robot),
                        fmt::format("leave the camera {} out", camera.from));
  }
  return {};
}

}  // namespace

std::optional<int> collisions_of(std::vector<std::unique_ptr<SimulatedBuilding>> const& buildings,
                                 std::string const& robot) {
  for (auto const& simulated : buildings) {
    auto const found = std::ranges::find(simulated->robots, robot);
    if (found == simulated->robots.end()) continue;
    auto const number = static_cast<std::uint32_t>(found - simulated->robots.begin());
    return static_cast<int>(std::ranges::count(simulated->building->collisions(), number, &building::Collision::robot));
  }
  return std::nullopt;
}

base::Result<std::vector<RobotToAdd>> make_robots(base::Loop& loop, std::vector<std::string> const& requests,
                                                  std::string const& site, geo::Wgs84 const& anchor, std::uint64_t seed,
                                                  CamerasOfRobots const& cameras,
                                                  std::vector<std::unique_ptr<SimulatedBuilding>>& buildings,
                                                  base::Logger const& log) {
  Maker maker(loop, site, anchor, seed, cameras, buildings, log);
  for (auto const& text : requests) {
    auto const request = parse_robot(text);
    if (!request) return std::unexpected(request.error());
    if (auto made = std::visit(maker, *request); !made) return std::unexpected(made.error());
  }
  auto made = maker.take();
  if (auto fits = check_cameras(cameras.cameras, made, buildings); !fits) return std::unexpected(fits.error());
  return made;
}

}  // namespace lapwing::host
