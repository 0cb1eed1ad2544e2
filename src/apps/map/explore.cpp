#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "apps/verb.hpp"
#include "explore/run/exploration.hpp"
#include "explore/run/picture.hpp"
#include "explore/run/starts.hpp"
#include "formats/ros_map.hpp"
#include "geo/position_json.hpp"

namespace lapwing::apps {

namespace {

using explore::Exploration;
using geo::Json;
using geo::rounded;

struct ExploreOptions {
  std::filesystem::path map;
  std::filesystem::path report;
  std::filesystem::path picture;
  std::vector<double> start;  ///< x, y, yaw in the map's frame
  int runs = 1;
  explore::Settings settings;
};

/// The pose of --start in the plan's frame.
explore::Pose pose_in(explore::FloorPlan const& plan, std::vector<double> const& start) {
  geo::Pose<geo::SiteFrame> const given{geo::Point<geo::SiteFrame>(start[0], start[1]),
                                        start.size() > 2 ? start[2] : 0.0};
  return plan.site_from_floor.inverse() * given;
}

Json start_json(explore::World const& world, explore::Pose const& start) {
  auto const pose = world.site_from_floor() * start;
  return Json::array({rounded(pose.position.x(), 3), rounded(pose.position.y(), 3), rounded(pose.yaw_rad, 4)});
}

Json run_json(explore::World const& world, explore::RunReport const& report, std::uint64_t seed, double wall_s) {
  auto const or_null = [](std::optional<double> value, int decimals) {
    return value ? rounded(*value, decimals) : Json(nullptr);
  };
  Json starts = Json::array();
  for (auto const& start : report.starts) starts.push_back(start_json(world, start));
  return {{"start", starts[0]},
          {"travel_m", rounded(report.travel_m, 2)},
          {"time_s", rounded(report.time_s, 1)},
          {"coverage", rounded(report.coverage, 5)},
          {"finished", report.is_finished},
          {"reason", explore::to_string(report.ending)},
          {"travel_to_99_m", or_null(report.travel_to_99_m, 2)},
          {"time_to_99_s", or_null(report.time_to_99_s, 1)},
          {"longest_travel_m", rounded(report.longest_travel_m, 2)},
          {"collisions", report.collisions},
          {"starts", std::move(starts)},
          {"seed", seed},
          {"wall_s", rounded(wall_s, 2)}};
}

/// On a terminal one line that changes; elsewhere nothing until the end.
void show(int run, int runs, Exploration const& exploration) {
  if (isatty(STDERR_FILENO) == 0) return;
  fmt::print(stderr, "\r\033[Krun {} of {}: {:5.1f} % seen, {:.0f} m, {:.0f} s", run, runs,
             exploration.coverage() * 100.0, exploration.travel_m(), exploration.time_s());
}

/// Makes each run's world once a start needs another one: most starts lie in the same part of the floor.
class Worlds {
 public:
  explicit Worlds(explore::FloorPlan const& plan) : plan_(plan) {}

  base::Result<std::shared_ptr<explore::World const>> around(explore::Pose const& start,
                                                             explore::Settings const& settings) {
    if (world_) {
      auto const cell = explore::cell_under(start.position - world_->plan_from_world(), world_->cell_m());
      if (world_->is_standable().or_else(cell, 0) != 0) return world_;
    }
    auto world = explore::World::around(plan_, start.position, settings);
    if (!world) return std::unexpected(world.error());
    world_ = std::make_shared<explore::World const>(std::move(*world));
    return world_;
  }

 private:
  explore::FloorPlan const& plan_;
  std::shared_ptr<explore::World const> world_;
};

base::Result<> write(std::filesystem::path const& path, std::string const& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file)
    return base::fail(base::ErrorKind::io, fmt::format("{} cannot be written", path.string()),
                      "does its folder exist, and is there room?");
  return {};
}

/// One floor, ready for any number of runs.
struct Floor {
  explore::FloorPlan plan;
  std::vector<explore::Place> possible;  ///< starts; empty where one is given
};

base::Result<Floor> read_floor(ExploreOptions const& options) {
  auto const grid = formats::read_ros_map(options.map);
  if (!grid) return std::unexpected(grid.error());
  auto plan = explore::floor_plan_of(*grid);
  if (!plan)
    return base::fail(plan.error().kind, fmt::format("{}: {}", options.map.string(), plan.error().message),
                      plan.error().hint);
  Floor floor{std::move(*plan), {}};
  if (options.start.empty()) floor.possible = explore::possible_starts(floor.plan, options.settings);
  return floor;
}

base::Result<Json> run_once(ExploreOptions const& options, Floor const& floor, Worlds& worlds, int number) {
  auto settings = options.settings;
  settings.seed += static_cast<std::uint64_t>(number);
  auto const began = std::chrono::steady_clock::now();
  auto const first = options.start.empty() ? explore::random_start(floor.plan, floor.possible, settings.seed)
                                           : pose_in(floor.plan, options.start);
  if (!first) return std::unexpected(first.error());
  auto const world = worlds.around(*first, settings);
  if (!world) return std::unexpected(world.error());
  auto const starts =
      explore::starts_around(**world, {first->position - (*world)->plan_from_world(), first->yaw_rad}, settings);
  if (!starts) return std::unexpected(starts.error());
  auto exploration = Exploration::begin(*world, settings, *starts);
  if (!exploration) return std::unexpected(exploration.error());
  for (int steps = 0; exploration->step(); ++steps) {
    if (steps % 5000 == 0) show(number + 1, options.runs, *exploration);
  }
  if (isatty(STDERR_FILENO) != 0) fmt::print(stderr, "\r\033[K");
  auto const report = exploration->report();
  double const wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  fmt::print("{:3}  {:8.1f} m  {:8.0f} s  {:6.2f} %  {}{}\n", number + 1, report.travel_m, report.time_s,
             report.coverage * 100.0, explore::to_string(report.ending), report.is_finished ? ", returned" : "");
  std::fflush(stdout);
  if (!options.picture.empty() && number == 0) {
    if (auto const written = write(options.picture, explore::svg_of(*exploration)); !written)
      return std::unexpected(written.error());
  }
  return run_json(**world, report, settings.seed, wall_s);
}

base::Result<Json> explore_floor(ExploreOptions const& options) {
  auto const floor = read_floor(options);
  if (!floor) return std::unexpected(floor.error());
  Worlds worlds(floor->plan);
  Json runs = Json::array();
  for (int i = 0; i < options.runs; ++i) {
    auto run = run_once(options, *floor, worlds, i);
    if (!run) return std::unexpected(run.error());
    runs.push_back(std::move(*run));
  }
  return Json{{"strategy", options.settings.strategy},
              {"robots", options.settings.robots},
              {"map", options.map.string()},
              {"runs", std::move(runs)}};
}

int run_explore(ExploreOptions const& options) {
  auto const report = explore_floor(options);
  if (!report) return host::refuse(report.error());
  if (options.report.empty()) return host::exit_done;
  auto const written = write(options.report, report->dump(2) + '\n');
  return written ? host::exit_done : host::refuse(written.error());
}

}  // namespace

void add_explore(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<ExploreOptions>();
  auto& settings = options->settings;
  auto* verb = begin_verb(program, "explore");
  std::string names;
  for (auto const& strategy : explore::strategy_names())
    names += fmt::format("{}{}", names.empty() ? "" : ", ", strategy.name);
  verb->add_option("--map", options->map, "Floor plan: a ROS map's .yaml, beside its picture (PGM, PNG)")->required();
  verb->add_option("--strategy", settings.strategy,
                   "How the robots choose where to go: " + names +
                       fmt::format("; {} is told the plan, as a yardstick", Exploration::known_floor))
      ->capture_default_str();
  verb->add_option("--robots", settings.robots, "How many, 1 to 8")->check(CLI::Range(1, 8))->capture_default_str();
  verb->add_option("--seed", settings.seed, "Starts, noise and people; run i has seed + i")->capture_default_str();
  verb->add_option("--start", options->start,
                   "X,Y[,YAW] of the first robot in metres and radians of the map; default: anywhere, by the seed")
      ->delimiter(',')
      ->expected(2, 3);
  verb->add_option("--runs", options->runs, "How many runs")->check(CLI::Range(1, 1000))->capture_default_str();
  verb->add_option("--people", settings.people, "How many people walk about")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  verb->add_option("--energy", settings.energy_m, "Metres that each robot's battery takes it; 0: any way")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  verb->add_option("--range", settings.laser.range_m, "Metres that the laser sees")
      ->check(CLI::Range(1.0, 100.0))
      ->capture_default_str();
  verb->add_option("--radius", settings.carrier.radius_m, "Metres from a robot's middle to its rim")
      ->check(CLI::Range(0.05, 1.0))
      ->capture_default_str();
  verb->add_option("--speed", settings.carrier.speed_m_s, "Metres a second at most")
      ->check(CLI::Range(0.05, 2.0))
      ->capture_default_str();
  verb->add_option("--time-limit", settings.most_time_s, "Simulated seconds after which a run ends")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("--picture", options->picture, "Draw the first run: its map and paths, as SVG");
  verb->add_option("--report", options->report, "Write the report as JSON");
  verb->callback([options, &exit_code] { exit_code = run_explore(*options); });
}

}  // namespace lapwing::apps
