#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "apps/verb.hpp"
#include "base/async/parallel_for.hpp"
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
  unsigned threads = 0;  ///< 0: as many as the machine has
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

/// Makes the world of each part of the floor once: most starts lie in the same one.
class Worlds {
 public:
  explicit Worlds(explore::FloorPlan const& plan) : plan_(plan) {}

  base::Result<std::shared_ptr<explore::World const>> around(explore::Pose const& start,
                                                             explore::Settings const& settings) {
    for (auto const& world : worlds_) {
      auto const cell = explore::cell_under(start.position - world->plan_from_world(), world->cell_m());
      if (world->is_standable().or_else(cell, 0) != 0) return world;
    }
    auto world = explore::World::around(plan_, start.position, settings);
    if (!world) return std::unexpected(world.error());
    return worlds_.emplace_back(std::make_shared<explore::World const>(std::move(*world)));
  }

 private:
  explore::FloorPlan const& plan_;
  std::vector<std::shared_ptr<explore::World const>> worlds_;
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

/// One run, ready to begin.
struct Run {
  explore::Settings settings;
  std::shared_ptr<explore::World const> world;
  std::vector<explore::Pose> starts;
};

base::Result<std::vector<Run>> lay_out(ExploreOptions const& options, Floor const& floor) {
  Worlds worlds(floor.plan);
  std::vector<Run> runs;
  for (int i = 0; i < options.runs; ++i) {
    auto settings = options.settings;
    settings.seed += static_cast<std::uint64_t>(i);
    auto const first = options.start.empty() ? explore::random_start(floor.plan, floor.possible, settings.seed)
                                             : pose_in(floor.plan, options.start);
    if (!first) return std::unexpected(first.error());
    auto world = worlds.around(*first, settings);
    if (!world) return std::unexpected(world.error());
    auto starts =
        explore::starts_around(**world, {first->position - (*world)->plan_from_world(), first->yaw_rad}, settings);
    if (!starts) return std::unexpected(starts.error());
    runs.push_back({std::move(settings), *std::move(world), *std::move(starts)});
  }
  return runs;
}

/// What was found, told in the order of the runs by whichever threads they ended on.
class Findings {
 public:
  explicit Findings(std::size_t runs) : runs_(runs) {}

  /// On a terminal one line that changes; elsewhere nothing.
  void show(std::size_t run, Exploration const& exploration) {
    if (!is_terminal_) return;
    std::scoped_lock const lock(mutex_);
    fmt::print(stderr, "\r\033[Krun {} of {}: {:5.1f} % seen, {:.0f} m, {:.0f} s", run + 1, runs_.size(),
               exploration.coverage() * 100.0, exploration.travel_m(), exploration.time_s());
  }

  void add(std::size_t run, std::string line, Json report) {
    std::scoped_lock const lock(mutex_);
    if (is_terminal_) fmt::print(stderr, "\r\033[K");
    runs_[run] = {std::move(line), std::move(report)};
    for (; told_ < runs_.size() && !runs_[told_].report.is_null(); ++told_) fmt::print("{}\n", runs_[told_].line);
    std::fflush(stdout);
  }

  void fail(base::Error error) {
    std::scoped_lock const lock(mutex_);
    if (!error_) error_ = std::move(error);
  }
  [[nodiscard]] bool has_failed() {
    std::scoped_lock const lock(mutex_);
    return error_.has_value();
  }

  /// When all have ended.
  [[nodiscard]] base::Result<Json> reports() {
    if (error_) return std::unexpected(*error_);
    Json all = Json::array();
    for (auto& run : runs_) all.push_back(std::move(run.report));
    return all;
  }

 private:
  struct Found {
    std::string line;
    Json report;
  };

  bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  std::mutex mutex_;
  std::vector<Found> runs_;
  std::size_t told_ = 0;
  std::optional<base::Error> error_;
};

base::Result<> explore_once(ExploreOptions const& options, Run const& run, std::size_t number, Findings& findings) {
  auto const began = std::chrono::steady_clock::now();
  auto exploration = Exploration::begin(run.world, run.settings, run.starts);
  if (!exploration) return std::unexpected(exploration.error());
  for (int steps = 0; exploration->step(); ++steps) {
    if (steps % 5000 == 0) findings.show(number, *exploration);
  }
  auto const report = exploration->report();
  double const wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  if (!options.picture.empty() && number == 0) {
    if (auto const written = write(options.picture, explore::svg_of(*exploration)); !written) return written;
  }
  findings.add(
      number,
      fmt::format("{:3}  {:8.1f} m  {:8.0f} s  {:6.2f} %  {}{}", number + 1, report.travel_m, report.time_s,
                  report.coverage * 100.0, explore::to_string(report.ending), report.is_finished ? ", returned" : ""),
      run_json(*run.world, report, run.settings.seed, wall_s));
  return {};
}

base::Result<Json> explore_floor(ExploreOptions const& options) {
  auto const floor = read_floor(options);
  if (!floor) return std::unexpected(floor.error());
  auto const runs = lay_out(options, *floor);
  if (!runs) return std::unexpected(runs.error());
  auto const threads = options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
  Findings findings(runs->size());
  base::parallel_for(threads, runs->size(), [&](std::size_t i) {
    if (findings.has_failed()) return;
    if (auto done = explore_once(options, (*runs)[i], i, findings); !done) findings.fail(std::move(done.error()));
  });
  auto reports = findings.reports();
  if (!reports) return reports;
  return Json{{"strategy", options.settings.strategy},
              {"robots", options.settings.robots},
              {"map", options.map.string()},
              {"runs", *std::move(reports)}};
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
  verb->add_option("--threads", options->threads,
                   "How many runs at once; default: as many as the machine has threads. They are the same")
      ->check(CLI::Range(1U, 256U));
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
