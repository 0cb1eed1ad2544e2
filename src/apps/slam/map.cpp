#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/slam/localise.hpp"
#include "apps/slam/map_files.hpp"
#include "apps/slam/map_graph.hpp"
#include "apps/slam/map_report.hpp"
#include "apps/slam/recorded_log.hpp"
#include "apps/verb.hpp"
#include "base/async/parallel_for.hpp"
#include "base/files/replace_file.hpp"
#include "base/text/json.hpp"
#include "scans/storage/bag_files.hpp"
#include "slam/graph/g2o.hpp"
#include "slam/grid/draw_grid.hpp"
#include "slam/mapper.hpp"
#include "slam/mapper_parameters.hpp"
#include "slam/relations.hpp"
#include "slam/walls/wall_lines.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct MapOptions {
  fs::path log;
  fs::path out;
  fs::path relations;
  scans::BagChoice topics;
  fs::path known_map;
  std::string start;
  unsigned threads = 0;
  std::vector<std::string> settings;
  bool wants_loops = false;
};

std::vector<slam::TimedPose> timed(slam::ScanLog const& log, std::vector<slam::Pose2> const& trajectory) {
  std::vector<slam::TimedPose> poses;
  for (std::size_t i = 0; i < trajectory.size(); ++i) poses.push_back({log.scans[i].time, trajectory[i]});
  return poses;
}

Json report_of(slam::ScanLog const& log, slam::Mapping const& mapping, std::vector<slam::TimedPose> const& poses,
               std::vector<slam::Relation> const& relations) {
  Json report;
  report["scans"] = log.scans.size();
  report["key_frames"] = mapping.graph.frames.size();
  report["closures"] = mapping.loops.closures;
  report["closures_doubted"] = mapping.loops.doubted;
  report["closures_revoked"] = mapping.loops.revoked;
  report["path_m"] = mapping.graph.frames.empty() ? 0.0 : mapping.graph.frames.back().path_m;
  if (!relations.empty()) report["relations"] = relations_json(poses, relations);
  return report;
}

void print_summary(Json const& report) {
  fmt::print("{} scans, {} key frames, {} closures; {:.1f} s ({:.1f} s of CPU), {:.0f} MB\n",
             report["scans"].get<int>(), report["key_frames"].get<int>(), report["closures"].get<int>(),
             report["wall_s"].get<double>(), report["cpu_s"].get<double>(), report["peak_mb"].get<double>());
  if (!report.contains("relations")) return;
  auto const& relations = report["relations"];
  for (auto const* kind : {"component", "motion"}) {
    auto const& shift = relations[kind]["translation_m"];
    auto const& turn = relations[kind]["rotation_deg"];
    fmt::print("{:9} of {} relations: {:.4f} +- {:.4f} m (max {:.3f}), {:.3f} +- {:.3f} degrees\n", kind,
               relations["count"].get<int>(), shift["mean"].get<double>(), shift["std"].get<double>(),
               shift["max"].get<double>(), turn["mean"].get<double>(), turn["std"].get<double>());
  }
}

/// Of words `name=value`.
base::Result<slam::MapperOptions> mapper_options(std::vector<std::string> const& settings) {
  slam::MapperOptions options;
  for (auto const& setting : settings) {
    auto const equals = setting.find('=');
    auto const name = setting.substr(0, equals);
    auto const all = slam::all_parameters();
    auto const found = std::ranges::find(all, name, &slam::Parameter::name);
    char* end = nullptr;
    auto const* begin = equals == std::string::npos ? "" : setting.c_str() + equals + 1;
    auto const value = std::strtod(begin, &end);
    if (found == all.end() || end == begin || *end != '\0' || !std::isfinite(value))
      return base::fail(base::ErrorKind::invalid_input, fmt::format("--set {}: not a parameter and a number", setting),
                        "docs/reference/slam.md lists the parameters");
    found->set(options, value);
  }
  return options;
}

Json loops_json(slam::ScanLog const& log, slam::Mapping const& mapping) {
  auto list = Json::array();
  for (auto const& r : mapping.loop_records)
    list.push_back({{"query", r.query},
                    {"target", r.target},
                    {"query_s", log.scans[mapping.graph.frames[r.query].scan].time.count()},
                    {"target_s", log.scans[mapping.graph.frames[r.target].scan].time.count()},
                    {"window_m", r.window.reach_m},
                    {"window_rad", r.window.reach_rad},
                    {"score", r.score},
                    {"rival", r.rival},
                    {"conflict", r.conflict},
                    {"matches", r.matches},
                    {"shift_m", r.shift_m},
                    {"turn_rad", r.turn_rad},
                    {"witnesses", r.witnesses},
                    {"contradiction", r.contradiction},
                    {"was_contradiction", r.was_contradiction},
                    {"is_late", r.is_late},
                    {"verdict", to_string(r.verdict)}});
  return list;
}

/// Lines of metres in the map's frame, the longest wall first.
std::string walls_csv(std::vector<slam::WallLine> const& walls) {
  std::string text = "from_x_m,from_y_m,to_x_m,to_y_m,spread_m\n";
  for (auto const& wall : walls)
    text += fmt::format("{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n", wall.from.x(), wall.from.y(), wall.to.x(), wall.to.y(),
                        wall.spread_m);
  return text;
}

/// The report comes last: whoever sees it finds the others.
base::Result<> write_results(MapOptions const& options, slam::ScanLog const& log, slam::Mapping const& mapping,
                             map::OccupancyGrid const& grid, std::vector<slam::TimedPose> const& poses,
                             std::vector<slam::WallLine> const& walls, Json const& report) {
  auto const write = [&](char const* name, std::string const& text) {
    return base::replace_file(options.out / name, text);
  };
  if (options.wants_loops)
    if (auto done = write("loops.json", base::to_text(loops_json(log, mapping), 1)); !done) return done;
  if (!grid.tiles().empty())
    if (auto done = write_map(grid, options.out); !done) return done;
  if (auto done = write("walls.csv", walls_csv(walls)); !done) return done;
  if (auto done = write("trajectory.tum", tum_text(poses)); !done) return done;
  if (auto done = write("graph.g2o", slam::write_g2o(mapping.graph.poses, mapping.graph.constraints)); !done)
    return done;
  return write("report.json", base::to_text(report, 2) + "\n");
}

base::Result<> make_map(MapOptions const& options) {
  auto const started = std::chrono::steady_clock::now();
  auto const relations = read_relations(options.relations);
  if (!relations) return std::unexpected(relations.error());
  auto const settings = mapper_options(options.settings);
  if (!settings) return std::unexpected(settings.error());
  std::optional<slam::Pose2> start;
  if (!options.start.empty()) {
    auto const parsed = parse_start(options.start);
    if (!parsed) return std::unexpected(parsed.error());
    start = *parsed;
  }
  bool const is_bag = scans::is_bag(options.log);
  auto text = is_bag ? std::string() : read_file(options.log);
  if (!text) return std::unexpected(text.error());
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error) return base::fail(base::ErrorKind::io, fmt::format("{}: {}", options.out.string(), error.message()));
  if (is_pose_graph(*text)) {
    auto done = settle_graph(*text, options.out);
    return done ? done : in_file(options.log, done.error());
  }
  auto recorded = is_bag ? read_bag_log(options.log, options.topics) : read_text_log(options.log, *std::move(text));
  if (!recorded) return std::unexpected(recorded.error());
  for (auto const& remark : recorded->remarks) fmt::print(stderr, "{}: {}\n", options.log.string(), remark);
  if (!options.known_map.empty()) {
    return localise(*std::move(recorded), *relations, {.map = options.known_map, .start = start}, options.out);
  }
  auto const& log = recorded->log;

  auto const threads = options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
  slam::ForEach const for_each = [threads](std::size_t count, std::function<void(std::size_t)> const& work) {
    base::parallel_for(threads, count, work);
  };
  ScanTimes times;
  ProgressLine line;
  auto const mapping = slam::map_log(log, *settings, for_each, [&](std::string_view stage, double share) {
    times(stage);
    line(stage, share);
  });
  auto const grid = slam::draw_grid(log, mapping.trajectory, {});
  auto const walls = slam::find_walls(grid);
  auto const poses = timed(log, mapping.trajectory);
  auto report = report_of(log, mapping, poses, *relations);
  if (is_bag) report["bag"] = bag_json(*recorded);
  add_use(report, started, times);
  report["threads"] = threads;
  if (auto done = write_results(options, log, mapping, grid, poses, walls, report); !done) return done;
  print_summary(report);
  return {};
}

}  // namespace

void add_map(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<MapOptions>();
  auto* verb = begin_verb(program, "map");
  verb->add_option("log", options->log,
                   "What a robot recorded: a bag of ROS 2 (.mcap, .db3 or their folder), a log of CARMEN (.clf, .log), "
                   "a table of "
                   "few ranges, or a pose graph (.g2o)")
      ->required()
      ->check(CLI::ExistingPath);
  verb->add_option("--scan-topic", options->topics.scan_topic, "Which sensor_msgs/LaserScan of a bag that has several");
  verb->add_option("--odom-topic", options->topics.odometry_topic,
                   "Which nav_msgs/Odometry of a bag that has several, or /tf");
  verb->add_option("--out", options->out,
                   "Folder for map.pgm, map.yaml, map.png, walls.csv, trajectory.tum, graph.g2o, report.json")
      ->required();
  auto* known = verb->add_option("--localise", options->known_map,
                                 "A ROS map (.yaml) on which the scans are laid, instead of making one: "
                                 "trajectory.tum, fits.csv, report.json")
                    ->check(CLI::ExistingFile);
  verb->add_option("--start", options->start,
                   "x,y,heading of the first scan on that map, metres and degrees; default: it is searched for")
      ->needs(known);
  verb->add_option("--relations", options->relations, "True relative poses to measure the trajectory with")
      ->check(CLI::ExistingFile);
  verb->add_option("--threads", options->threads, "How many; default: as many as the machine has. The map is the same")
      ->check(CLI::Range(1U, 256U));
  verb->add_option("--set", options->settings, "PARAMETER=NUMBER, as in docs/reference/slam.md");
  verb->add_flag("--loops", options->wants_loops,
                 "Write loops.json too: every place that was looked for, and what became of it");
  verb->callback([options, &exit_code] {
    auto const made = make_map(*options);
    exit_code = made ? host::exit_done : host::refuse(made.error());
  });
}

}  // namespace lapwing::apps
