// Looks at a building file: usage: building_hand picture FILE X Y YAW_DEG OUT.ppm [WIDTH]
//                                 building_hand speed FILE SECONDS [PICTURES_PER_S]
//                                 building_hand serve FILE URL
// `picture` is what a robot's camera sees from there. `speed` tells how many seconds are simulated in one; the robot
// turns on the spot meanwhile. `serve` gives its board's line at the URL, for programs that take it for a real one;
// what can be broken meanwhile is in served_building.hpp.

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "firmware/frames/codec.hpp"
#include "sim/building/building.hpp"
#include "sim/building/plan/building_file.hpp"
#include "sim/building/testing/served_building.hpp"

namespace lapwing::sim::building {
namespace {

std::unique_ptr<Building> open(std::string const& path, BuildingOptions options) {
  std::ifstream file(path);
  std::string const text{std::istreambuf_iterator<char>(file), {}};
  auto plan = building_of(path, text);
  if (!plan) {
    fmt::print(stderr, "{}", plan.error().message);
    std::exit(2);
  }
  auto building = Building::make(*std::move(plan), std::move(options));
  if (!building) {
    fmt::print(stderr, "{}; {}\n", building.error().message, building.error().hint);
    std::exit(2);
  }
  return *std::move(building);
}

int picture(std::vector<std::string> const& words) {
  auto const building = open(words[1], {.seed = 1, .robots = 0});
  CameraSettings camera;
  if (words.size() > 6) {
    camera.width = std::stoi(words[6]);
    camera.height = camera.width * 3 / 4;
  }
  Pose const pose{{std::stod(words[2]), std::stod(words[3])}, std::stod(words[4]) * std::numbers::pi / 180.0};
  auto const began = std::chrono::steady_clock::now();
  auto const seen = develop(building->shoot_from(camera_on(pose, camera), camera));
  fmt::print("{:.1f} ms\n",
             std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count());
  std::ofstream(words[5], std::ios::binary) << ppm_of(seen);
  return 0;
}

int speed(std::vector<std::string> const& words) {
  auto const building = open(words[1], {.seed = 1, .robots = 1});
  double const seconds = std::stod(words[2]);
  double const pictures = words.size() > 3 ? std::stod(words[3]) : 0.0;
  auto& robot = building->robot(0);
  auto const began = std::chrono::steady_clock::now();
  double next_picture_s = 0.0;
  double next_command_s = 0.0;
  firmware::CommandNumber number = 0;
  std::size_t bytes = 0;
  while (building->time_s() < seconds) {
    if (building->time_s() >= next_command_s) {
      next_command_s += 0.2;
      ++number;
      auto const frame =
          firmware::write(firmware::FromHost(firmware::Drive{
                              .number = number, .speed_m_s = 0.0F, .by = firmware::Drive::By::rate, .turn = 0.5F}),
                          static_cast<std::uint8_t>(number));
      robot.to_board(frame.view());
    }
    building->step();
    bytes += robot.from_board().size();
    if (pictures > 0.0 && building->time_s() >= next_picture_s) {
      next_picture_s += 1.0 / pictures;
      (void)develop(*building->shoot(0));
    }
  }
  double const wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  fmt::print(
      "{:.1f} simulated seconds a second ({} bytes a second over the line, turned to {:.3f} rad, {} collisions)\n",
      seconds / wall_s, static_cast<double>(bytes) / seconds, robot.body().pose().yaw_rad,
      building->collisions().size());
  return 0;
}

int serve(std::vector<std::string> const& words) {
  auto const url = link::parse_url(words[2]);
  if (!url) {
    fmt::print(stderr, "{}; {}\n", url.error().message, url.error().hint);
    return 2;
  }
  return testing::serve(*open(words[1], {.seed = 1, .robots = 1}), *url);
}

}  // namespace
}  // namespace lapwing::sim::building

int main(int count, char** arguments) {
  std::vector<std::string> const words(arguments + 1, arguments + count);
  if (words.size() >= 6 && words[0] == "picture") return lapwing::sim::building::picture(words);
  if (words.size() >= 3 && words[0] == "speed") return lapwing::sim::building::speed(words);
  if (words.size() == 3 && words[0] == "serve") return lapwing::sim::building::serve(words);
  fmt::print(stderr,
             "usage: building_hand picture FILE X Y YAW_DEG OUT.ppm [WIDTH] | speed FILE SECONDS [PICTURES_PER_S] | "
             "serve FILE URL\n");
  return 2;
}
