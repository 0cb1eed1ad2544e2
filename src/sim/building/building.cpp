#include "sim/building/building.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "sim/building/plan/door_opening.hpp"

namespace lapwing::sim::building {

namespace {

/// Laser, sonars and the hull are all at this height.
constexpr double sensors_up_m = 0.2;
/// Beside what a robot needs itself, where nobody said where it starts.
constexpr double spare_m = 0.15;

Shift unit(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

std::vector<std::shared_ptr<Lettering const>> letterings_of(std::vector<DoorFrame> const& doors) {
  std::vector<std::shared_ptr<Lettering const>> letterings;
  for (auto const& door : doors) letterings.push_back(door.text.empty() ? nullptr : lettering_of(sign_at(door, 0.0)));
  return letterings;
}

/// Signs on walls hang still, those on leaves do not.
std::shared_ptr<std::vector<Surface> const> fixed_surfaces(
    BuildingPlan const& plan, Bodies const& bodies, std::span<std::shared_ptr<Lettering const> const> lettering) {
  auto surfaces = surfaces_of(plan, bodies);
  for (std::size_t i = 0; i < lettering.size(); ++i) {
    if (lettering[i] && !bodies.doors[i].is_sign_on_leaf)
      add_sign(sign_at(bodies.doors[i], 0.0), lettering[i], surfaces);
  }
  return std::make_shared<std::vector<Surface> const>(std::move(surfaces));
}

base::Result<> check(BuildingPlan const& plan, BuildingOptions const& options) {
  auto const wrong = [](std::string message, std::string hint) {
    return base::fail(base::ErrorKind::invalid_input, std::move(message), std::move(hint));
  };
  if (options.robots < 0 || options.robots > Building::most_robots)
    return wrong(fmt::format("{} robots cannot be simulated in one building", options.robots),
                 fmt::format("0 to {}", Building::most_robots));
  for (auto const& door : plan.doors) {
    if (!opening_of(door, plan.walls))
      return wrong(fmt::format("the door {} stands in no wall", door.id),
                   "hinge and latch must both lie on one wall's line, to a centimetre");
  }
  if (plan.walls.empty() && plan.borders.empty()) return wrong("the building has no wall", "draw one");
  return {};
}

/// Walls all around, however far.
bool is_indoors(Surroundings const& around, Place const& place) {
  constexpr int ways = 8;
  constexpr double farthest_m = 500.0;
  for (int i = 0; i < ways; ++i) {
    if (!around.fixed.cast(place, unit((i + 0.3) * 2.0 * std::numbers::pi / ways), farthest_m)) return false;
  }
  return true;
}

}  // namespace

base::Result<std::unique_ptr<Building>> Building::make(BuildingPlan plan, BuildingOptions options) {
  if (auto fine = check(plan, options); !fine) return std::unexpected(fine.error());
  auto bodies = bodies_of(plan);
  std::unique_ptr<Building> building(new Building(std::move(plan), std::move(options), std::move(bodies)));
  if (auto placed = building->place_robots(); !placed) return std::unexpected(placed.error());
  return building;
}

Building::Building(BuildingPlan plan, BuildingOptions options, Bodies bodies)
    : plan_(std::move(plan)),
      options_(std::move(options)),
      lettering_(letterings_of(bodies.doors)),
      surfaces_(fixed_surfaces(plan_, bodies, lettering_)),
      faces_(faces_of(plan_, bodies, sensors_up_m)),
      doors_(plan_.doors, std::move(bodies.doors), options_.seed),
      people_(plan_.people, options_.seed) {}

Surroundings Building::surroundings() const {
  Surroundings around{.fixed = faces_, .moving = {doors_.faces().begin(), doors_.faces().end()}};
  people_.add_posts(around.posts);
  for (auto const& robot : robots_) around.posts.push_back(robot->post());
  return around;
}

bool Building::has_room(Place const& middle, double radius_m) const {
  double nearest_m = std::numeric_limits<double>::infinity();
  bool is_outside = true;
  auto const look = [&](Face const& face) {
    double const away_m = distance_m(nearest_point(face, middle), middle);
    if (away_m >= nearest_m) return;
    nearest_m = away_m;
    is_outside = (face.to - face.from).cross(middle - face.from) <= 0.0;
  };
  // Faces beyond would not make room any larger.
  constexpr double reach_m = 3.0;
  faces_.near(middle, std::max(radius_m, reach_m), look);
  if (nearest_m < radius_m || !is_outside) return false;
  for (auto const& face : doors_.faces()) look(face);
  if (nearest_m < radius_m || !is_outside) return false;
  auto const around = surroundings();
  return std::ranges::none_of(
      around.posts, [&](Post const& post) { return distance_m(post.middle, middle) < post.radius_m + radius_m; });
}

std::optional<Pose> Building::place_near(Pose const& first) const {
  double const radius_m = options_.robot.drive.radius_m + spare_m;
  constexpr double step_m = 0.25;
  constexpr int farthest = 40;
  for (int ring = 1; ring <= farthest; ++ring) {
    for (int i = 0; i < 6 * ring; ++i) {
      auto const place = first.position + ring * step_m * unit(i * 2.0 * std::numbers::pi / (6 * ring));
      if (!has_room(place, radius_m)) continue;
      // Not through a wall.
      auto const way = place - first.position;
      auto const around = surroundings();
      if (around.fixed.cast(first.position, way * (1.0 / way.length()), way.length())) continue;
      return Pose{place, first.yaw_rad};
    }
  }
  return std::nullopt;
}

base::Result<> Building::place_robots() {
  auto const wrong = [](std::string message, std::string hint) {
    return base::fail(base::ErrorKind::invalid_input, std::move(message), std::move(hint));
  };
  auto wanted = options_.starts;
  for (std::size_t i = wanted.size(); i < plan_.starts.size(); ++i) wanted.push_back(plan_.starts[i]);
  if (wanted.empty() && options_.robots > 0) {
    Noise noise(options_.seed, "start");
    auto const extent = extent_of(plan_);
    constexpr int most_tries = 20'000;
    for (int i = 0; i < most_tries && wanted.empty() && extent; ++i) {
      Place const place(noise.uniform(extent->least.x(), extent->most.x()),
                        noise.uniform(extent->least.y(), extent->most.y()));
      if (has_room(place, options_.robot.drive.radius_m + spare_m) && is_indoors(surroundings(), place))
        wanted.push_back({place, noise.uniform(-std::numbers::pi, std::numbers::pi)});
    }
    if (wanted.empty())
      return wrong("there is no room for a robot in the building", "say where it starts: [[start]] at = [x, y]");
  }
  for (int i = 0; i < options_.robots; ++i) {
    auto const index = static_cast<std::size_t>(i);
    std::optional<Pose> pose;
    if (index < wanted.size()) {
      pose = wanted[index];
      if (!has_room(pose->position, options_.robot.drive.radius_m))
        return wrong(fmt::format("robot {} cannot start at {:.2f}, {:.2f}: it would touch something", i + 1,
                                 pose->position.x(), pose->position.y()),
                     "choose a free place, in metres of the building's frame");
    } else {
      pose = place_near(wanted.front());
      if (!pose)
        return wrong(fmt::format("there is no room for robot {} near the first", i + 1), "say where it starts");
    }
    robots_.push_back(std::make_unique<Robot>(options_.robot, *pose, options_.seed, static_cast<std::uint32_t>(i)));
    pictures_taken_.push_back(0);
  }
  return {};
}

void Building::step() {
  ++steps_;
  auto around = surroundings();
  doors_.step(step_s, [&](std::vector<Place> const& leaf) {
    std::vector<Face> faces;
    add_faces(leaf, {}, faces);
    constexpr double apart_m = 0.05;
    return std::ranges::any_of(around.posts, [&](Post const& post) {
      return std::ranges::any_of(faces, [&](Face const& face) {
        return distance_m(nearest_point(face, post.middle), post.middle) < post.radius_m + apart_m;
      });
    });
  });
  people_.step(step_s, around);
  around.moving.assign(doors_.faces().begin(), doors_.faces().end());
  around.posts.clear();
  people_.add_posts(around.posts);
  auto const people = around.posts.size();
  for (auto const& robot : robots_) around.posts.push_back(robot->post());
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    // A sensor does not see the robot that it is on: its rays begin inside.
    auto const news = robots_[i]->step(time_s(), step_s, around);
    collisions_.insert(collisions_.end(), news.begin(), news.end());
    around.posts[people + i] = robots_[i]->post();
  }
}

std::vector<Surface> Building::moving_surfaces(std::optional<std::size_t> without_robot) const {
  std::vector<Surface> surfaces;
  auto const frames = doors_.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    double const angle = doors_.angle_rad(i);
    add_solid({.ring = leaf_ring(frames[i], angle),
               .bottom_m = 0.005,
               .top_m = frames[i].height_m - 0.005,
               .material = Material::wood,
               .thing = Thing::door,
               .number = static_cast<std::uint32_t>(i),
               .look = Look::wood,
               .colour = frames[i].colour},
              surfaces);
    for (auto const& part : handles(frames[i], angle)) add_solid(part, surfaces);
    if (lettering_[i] && frames[i].is_sign_on_leaf) add_sign(sign_at(frames[i], angle), lettering_[i], surfaces);
  }
  auto const people = people_.all();
  for (std::size_t i = 0; i < people.size(); ++i) {
    for (auto const& part : figure_of(people[i], i)) add_solid(part, surfaces);
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (i == without_robot) continue;
    auto const& robot = *robots_[i];
    for (auto const& part :
         robot_figure(robot.body().pose(), robot.settings().drive.radius_m, robot.settings().camera.up_m))
      add_solid(part, surfaces);
  }
  return surfaces;
}

std::optional<Shot> Building::shoot(std::size_t robot) {
  return shoot(robot, robots_[robot]->settings().camera);
}

std::optional<Shot> Building::shoot(std::size_t robot, CameraSettings settings) {
  auto const& one = *robots_[robot];
  auto const number = pictures_taken_[robot]++;
  if (one.fault(Fault::Kind::camera_silent)) return std::nullopt;
  if (auto const* dark = one.fault(Fault::Kind::camera_dark)) settings.light *= dark->amount.value_or(0.1);
  if (auto const* blurred = one.fault(Fault::Kind::camera_blurred)) settings.defocus_px = blurred->amount.value_or(3.0);
  constexpr std::uint64_t most_pictures = 1'000'000'007;
  return Shot{.fixed = surfaces_,
              .moving = moving_surfaces(robot),
              .pose = camera_on(one.body().pose(), settings),
              .settings = settings,
              .turn_rad_s = one.body().turn_rad_s(),
              .noise = Noise(options_.seed, "camera", robot * most_pictures + number)};
}

Shot Building::shoot_from(CameraPose const& pose, CameraSettings const& settings) const {
  return {.fixed = surfaces_,
          .moving = moving_surfaces(std::nullopt),
          .pose = pose,
          .settings = settings,
          .turn_rad_s = 0.0,
          .noise = Noise(options_.seed, "visitor")};
}

std::vector<TrueDoor> Building::true_doors() const {
  std::vector<TrueDoor> doors;
  auto const frames = doors_.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    auto const& frame = frames[i];
    doors.push_back({.id = frame.id,
                     .middle = frame.middle,
                     .front_rad = frame.front_rad,
                     .width_m = frame.width_m,
                     .angle_rad = doors_.angle_rad(i),
                     .text = frame.text});
  }
  return doors;
}

}  // namespace lapwing::sim::building
