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
#include "apps/slam/map_logs.hpp"
#include "apps/slam/map_report.hpp"
#include "apps/slam/recorded_log.hpp"
#include "apps/slam/resume_map.hpp"
#include "apps/verb.hpp"
#include "base/async/parallel_for.hpp"
#include "base/files/replace_file.hpp"
#include "base/text/json.hpp"
#include "scans/storage/bag_files.hpp"
#include "slam/graph/g2o.hpp"
#include "slam/grid/draw_grid.hpp"
#include "slam/mapper_parameters.hpp"
#include "slam/relations.hpp"
#include "slam/walls/wall_lines.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct MapOptions {
  std::vector<fs::path> logs;
  fs::path out;
  fs::path relations;
  scans::BagChoice topics;
  fs::path known_map;
  fs::path resumed;
  std::string start;
  unsigned threads = 0;
  std::vector<std::string> settings;
  bool wants_loops = false;
};

Json report_of(LogsMap const& made, std::vector<slam::Relation> const& relations) {
  auto const& mapping = made.mapping;
  Json report;
  report["scans"] = made.log.scans.size();
  report["key_frames"] = mapping.graph.frames.size();
  report["closures"] = mapping.loops.closures;
  report["closures_doubted"] = mapping.loops.doubted;
  report["closures_revoked"] = mapping.loops.revoked;
  report["path_m"] = path_m(made.parts);
  if (made.parts.size() > 1) report["logs"] = parts_json(made.parts);
  if (!relations.empty()) report["relations"] = relations_json(in_time_order(made), relations);
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
    if (!slam::is_usable(*found, value))
      return base::fail(
          base::ErrorKind::invalid_input,
          fmt::format("--set {}: more than nothing, and within a factor of 1000 of {}", setting, found->get({})));
    found->set(options, value);
  }
  return options;
}

/// Lines of metres in the map's frame, the longest wall first.
std::string walls_csv(std::vector<slam::WallLine> const& walls) {
  std::string text = "from_x_m,from_y_m,to_x_m,to_y_m,spread_m\n";
  for (auto const& wall : walls)
    text += fmt::format("{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n", wall.from.x(), wall.from.y(), wall.to.x(), wall.to.y(),
                        wall.spread_m);
  return text;
}

/// With what it took, as that is not in `add_use` of the report.
base::Result<> write_state(MapOptions const& options, slam::Mapping const& mapping, Json& report) {
  if (!can_go_on(mapping)) return {};
  auto const started = std::chrono::steady_clock::now();
  if (auto done = write_state_file(mapping, options.out); !done) return done;
  std::chrono::duration<double, std::milli> const took = std::chrono::steady_clock::now() - started;
  std::error_code error;
  report["state"] = {{"bytes", fs::file_size(state_path(options.out), error)}, {"write_ms", took.count()}};
  return {};
}

/// The report comes last: whoever sees it finds the others.
base::Result<> write_results(MapOptions const& options, LogsMap const& made, map::OccupancyGrid const& grid,
                             std::vector<slam::WallLine> const& walls, Json report) {
  auto const write = [&](char const* name, std::string const& text) {
    return base::replace_file(options.out / name, text);
  };
  if (options.wants_loops)
    if (auto done = write("loops.json", base::to_text(loops_json(made), 1)); !done) return done;
  if (!grid.tiles().empty())
    if (auto done = write_map(grid, options.out); !done) return done;
  if (auto done = write("walls.csv", walls_csv(walls)); !done) return done;
  if (auto done = write_trajectories(made, options.out); !done) return done;
  auto const& graph = made.mapping.graph;
  if (auto done = write("graph.g2o", slam::write_g2o(graph.poses, graph.constraints)); !done) return done;
  if (auto done = write_state(options, made.mapping, report); !done) return done;
  return write("report.json", base::to_text(report, 2) + "\n");
}

/// A log, unless it is a pose graph, which is settled at once.
base::Result<std::optional<RecordedLog>> read_one(MapOptions const& options, fs::path const& path) {
  if (scans::is_bag(path)) {
    auto bag = read_bag_log(path, options.topics);
    if (!bag) return std::unexpected(bag.error());
    return std::optional(*std::move(bag));
  }
  auto text = read_file(path);
  if (!text) return std::unexpected(text.error());
  if (!is_pose_graph(*text)) {
    auto log = read_text_log(path, *std::move(text));
    if (!log) return std::unexpected(log.error());
    return std::optional(*std::move(log));
  }
  if (options.logs.size() > 1)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("{}: a pose graph has no scans to merge", path.string()));
  if (auto done = settle_graph(*text, options.out); !done) return in_file(path, done.error());
  return std::nullopt;
}

/// All logs; none where the one that was named is a pose graph.
base::Result<std::vector<RecordedLog>> read_all(MapOptions const& options) {
  std::vector<RecordedLog> recorded;
  for (auto const& path : options.logs) {
    auto log = read_one(options, path);
    if (!log) return std::unexpected(log.error());
    if (!*log) break;
    for (auto const& remark : (*log)->remarks) fmt::print(stderr, "{}: {}\n", path.string(), remark);
    recorded.push_back(**std::move(log));
  }
  return recorded;
}

/// What `make_map` was asked, read and parsed.
struct MapRequest {
  std::vector<slam::Relation> relations;
  slam::MapperOptions settings;
  std::optional<slam::Pose2> start;
  std::optional<slam::SavedMap> saved;
  double read_state_ms = 0.0;
};

base::Result<LogsMap> map_or_resume(MapOptions const& options, std::vector<RecordedLog> recorded, MapRequest request,
                                    slam::ForEach const& for_each, slam::Progress const& progress) {
  if (!request.saved) return map_logs(options.logs, std::move(recorded), request.settings, for_each, progress);
  return resume_map(*std::move(request.saved), options.logs.front(), std::move(recorded.front().log), request.start,
                    for_each, progress);
}

base::Result<> map_together(MapOptions const& options, std::vector<RecordedLog> recorded, MapRequest request,
                            std::chrono::steady_clock::time_point started) {
  auto const threads = options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
  slam::ForEach const for_each = [threads](std::size_t count, std::function<void(std::size_t)> const& work) {
    base::parallel_for(threads, count, work);
  };
  auto bags = bags_json(recorded);
  ScanTimes times;
  ProgressLine line;
  auto const relations = request.relations;
  auto const read_ms = request.read_state_ms;
  auto const progress = [&](std::string_view stage, double share) {
    times(stage);
    line(stage, share);
  };
  auto const made = map_or_resume(options, std::move(recorded), std::move(request), for_each, progress);
  if (!made) return std::unexpected(made.error());
  auto const grid = slam::draw_grid(made->log, made->mapping.trajectory, {});
  auto const walls = slam::find_walls(grid);
  auto report = report_of(*made, relations);
  if (!bags.is_null()) report["bag"] = std::move(bags);
  if (!made->beginning.empty())
    report["resumed"] = {{"from", options.resumed.string()}, {"beginning", made->beginning}, {"read_ms", read_ms}};
  add_use(report, started, times);
  report["threads"] = threads;
  if (auto done = write_results(options, *made, grid, walls, report); !done) return done;
  print_summary(report);
  return {};
}

/// What fits no other option, which the command line does not know.
base::Result<> check(MapOptions const& options) {
  bool const is_known = !options.known_map.empty();
  bool const is_resumed = !options.resumed.empty();
  if (is_known && options.logs.size() > 1)
    return base::fail(base::ErrorKind::invalid_input, "--localise lays one log on a map, not several");
  if (is_resumed && options.logs.size() > 1)
    return base::fail(base::ErrorKind::invalid_input, "--resume goes on with one log, not several",
                      "resume with one after the other");
  if (!options.start.empty() && !is_known && !is_resumed)
    return base::fail(base::ErrorKind::invalid_input,
                      "--start says where on a map a log begins: --localise or --resume");
  return {};
}

base::Result<MapRequest> read_request(MapOptions const& options) {
  MapRequest request;
  auto relations = read_relations(options.relations);
  if (!relations) return std::unexpected(relations.error());
  request.relations = *std::move(relations);
  auto const settings = mapper_options(options.settings);
  if (!settings) return std::unexpected(settings.error());
  request.settings = *settings;
  if (!options.start.empty()) {
    auto const start = parse_start(options.start);
    if (!start) return std::unexpected(start.error());
    request.start = *start;
  }
  if (options.resumed.empty()) return request;
  auto const started = std::chrono::steady_clock::now();
  auto saved = read_state_file(state_path(options.resumed));
  if (!saved) return std::unexpected(saved.error());
  request.saved = *std::move(saved);
  request.read_state_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started).count();
  return request;
}

base::Result<> make_map(MapOptions const& options) {
  auto const started = std::chrono::steady_clock::now();
  if (auto checked = check(options); !checked) return checked;
  auto request = read_request(options);
  if (!request) return std::unexpected(request.error());
  std::error_code error;
  fs::create_directories(options.out, error);
  if (error) return base::fail(base::ErrorKind::io, fmt::format("{}: {}", options.out.string(), error.message()));
  auto recorded = read_all(options);
  if (!recorded) return std::unexpected(recorded.error());
  if (recorded->empty()) return {};
  if (!options.known_map.empty())
    return localise(std::move(recorded->front()), request->relations,
                    {.map = options.known_map, .start = request->start}, options.out);
  return map_together(options, *std::move(recorded), *std::move(request), started);
}

}  // namespace

void add_map(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<MapOptions>();
  auto* verb = begin_verb(program, "map");
  verb->add_option("log", options->logs,
                   "What a robot recorded: a bag of ROS 2 (.mcap, .db3 or their folder), a log of CARMEN (.clf, .log), "
                   "a table of few ranges, or a pose graph (.g2o). Several logs of one building: one map of all")
      ->required()
      ->check(CLI::ExistingPath);
  verb->add_option("--scan-topic", options->topics.scan_topic, "Which sensor_msgs/LaserScan of a bag that has several");
  verb->add_option("--odom-topic", options->topics.odometry_topic,
                   "Which nav_msgs/Odometry of a bag that has several, or /tf");
  verb->add_option("--out", options->out,
                   "Folder for map.pgm, map.yaml, map.png, walls.csv, trajectory.tum, graph.g2o, mapping.state, "
                   "report.json")
      ->required();
  auto* known = verb->add_option("--localise", options->known_map,
                                 "A ROS map (.yaml) on which the scans are laid, instead of making one: "
                                 "trajectory.tum, fits.csv, report.json")
                    ->check(CLI::ExistingFile);
  auto* resumed =
      verb->add_option("--resume", options->resumed,
                       "A mapping that ended, which the log goes on with in the same frame: the folder that "
                       "it was written to, or the mapping.state in it")
          ->check(CLI::ExistingPath)
          ->excludes(known);
  verb->add_option("--start", options->start,
                   "x,y,heading of the first scan on that map, metres and degrees; default: it is searched for");
  verb->add_option("--relations", options->relations, "True relative poses to measure the trajectory with")
      ->check(CLI::ExistingFile);
  verb->add_option("--threads", options->threads, "How many; default: as many as the machine has. The map is the same")
      ->check(CLI::Range(1U, 256U));
  verb->add_option("--set", options->settings, "PARAMETER=NUMBER, as in docs/reference/slam.md")->excludes(resumed);
  verb->add_flag("--loops", options->wants_loops,
                 "Write loops.json too: every place that was looked for, and what became of it");
  verb->callback([options, &exit_code] {
    auto const made = make_map(*options);
    exit_code = made ? host::exit_done : host::refuse(made.error());
  });
}

}  // namespace lapwing::apps
