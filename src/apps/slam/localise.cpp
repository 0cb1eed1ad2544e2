#include "apps/slam/localise.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "apps/slam/map_report.hpp"
#include "base/files/replace_file.hpp"
#include "base/text/json.hpp"
#include "map/ros_files/ros_map_file.hpp"
#include "slam/known/localizer.hpp"
#include "slam/match/scan_odometry.hpp"
#include "slam/robot_kind.hpp"

namespace lapwing::apps {

namespace {

using Json = nlohmann::ordered_json;
constexpr double degree = std::numbers::pi / 180.0;

base::Result<slam::KnownMap> read_map(std::filesystem::path const& path) {
  auto const grid = map::read_ros_map(path, [](std::filesystem::path const& picture) -> base::Result<map::MapPicture> {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("{} is no PGM", picture.string()),
                      "nav2_map_server's map_saver writes one, and so does `lapwing map`");
  });
  if (!grid) return std::unexpected(grid.error());
  auto known = slam::KnownMap::make(*grid);
  if (!known) return in_file(path, known.error());
  return known;
}

/// A log without odometry gets some, made of its scans.
void give_odometry(slam::ScanLog& log, slam::FrameOptions const& options) {
  slam::ScanOdometry odometry;
  for (auto& scan : log.scans)
    scan.odometry =
        odometry.follow(slam::frame_of(scan, log.sensors[static_cast<std::size_t>(scan.sensor)], options), scan.time);
}

double percentile(std::vector<double> sorted, double share) {
  std::ranges::sort(sorted);
  return sorted.empty() ? 0.0 : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

std::string fits_csv(slam::ScanLog const& log, slam::Localization const& done) {
  std::string text = "time_s,x_m,y_m,yaw_rad,fit,is_lost\n";
  for (std::size_t i = 0; i < done.scans.size(); ++i) {
    auto const& scan = done.scans[i];
    fmt::format_to(std::back_inserter(text), "{:.6f},", log.scans[i].time.count());
    if (scan.is_lost)
      text += ",,,,1\n";
    else
      fmt::format_to(std::back_inserter(text), "{:.3f},{:.3f},{:.4f},{:.3f},0\n", scan.pose.x, scan.pose.y,
                     scan.pose.yaw, scan.fit);
  }
  return text;
}

Json report_of(slam::Localization const& done) {
  std::vector<double> fits;
  for (auto const& scan : done.scans)
    if (!scan.is_lost) fits.push_back(scan.fit);
  Json report{{"scans", done.scans.size()},
              {"lost", done.scans.size() - fits.size()},
              {"times_lost", done.times_lost},
              {"fit", {{"p5", percentile(fits, 0.05)}, {"p50", percentile(fits, 0.5)}}}};
  if (done.start)
    report["start"] = {
        {"x_m", done.start->pose.x},  {"y_m", done.start->pose.y},  {"heading_deg", done.start->pose.yaw / degree},
        {"score", done.start->score}, {"rival", done.start->rival}, {"scans", done.start->scans}};
  return report;
}

void print_summary(Json const& report) {
  fmt::print(
      "{} scans, {} of them lost; {:.0f} % of a scan's points lie on walls of the map in the middle of all; "
      "{:.1f} s ({:.2f} ms a scan)\n",
      report["scans"].get<int>(), report["lost"].get<int>(), 100.0 * report["fit"]["p50"].get<double>(),
      report["wall_s"].get<double>(), report["scan_ms"]["p50"].get<double>());
  if (report["times_lost"].get<int>() > 0)
    fmt::print("lost {} times on the way; fits.csv says when\n", report["times_lost"].get<int>());
}

}  // namespace

base::Result<slam::Pose2> parse_start(std::string const& text) {
  slam::Pose2 pose;
  auto const* at = text.c_str();
  double* const numbers[] = {&pose.x, &pose.y, &pose.yaw};
  for (auto* number : numbers) {
    char* end = nullptr;
    *number = std::strtod(at, &end);
    bool const is_last = number == &pose.yaw;
    if (end == at || !std::isfinite(*number) || *end != (is_last ? '\0' : ','))
      return base::fail(base::ErrorKind::invalid_input, fmt::format("--start {}: not x,y,heading", text),
                        "metres on the map and degrees counterclockwise from its x axis, as in --start 1.5,-2,90");
    at = is_last ? end : end + 1;
  }
  pose.yaw = geo::wrap_pi(pose.yaw * degree);
  return pose;
}

base::Result<> localise(RecordedLog recorded, std::vector<slam::Relation> const& relations,
                        LocaliseOptions const& options, std::filesystem::path const& out) {
  auto const started = std::chrono::steady_clock::now();
  auto const known = read_map(options.map);
  if (!known) return std::unexpected(known.error());
  slam::MapperOptions const mapper;
  auto const kind = slam::kind_of(recorded.log, mapper.gather);
  if (kind.is_sparse)
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("scans of fewer than {} readings are not laid on a known map", mapper.gather.few_readings));
  if (!kind.has_odometry) give_odometry(recorded.log, mapper.frame);
  ScanTimes times;
  ProgressLine line;
  auto const done =
      slam::localize_log(*known, recorded.log, options.start, mapper.frame, [&](std::string_view stage, double share) {
        times(stage);
        line(stage, share);
      });
  std::vector<slam::TimedPose> poses;
  for (std::size_t i = 0; i < done.scans.size(); ++i)
    if (!done.scans[i].is_lost) poses.push_back({recorded.log.scans[i].time, done.scans[i].pose});
  auto report = report_of(done);
  if (!relations.empty() && !poses.empty()) report["relations"] = relations_json(poses, relations);
  if (!recorded.scan_topic.empty()) report["bag"] = bag_json(recorded);
  add_use(report, started, times);
  if (auto wrote = base::replace_file(out / "trajectory.tum", tum_text(poses)); !wrote) return wrote;
  if (auto wrote = base::replace_file(out / "fits.csv", fits_csv(recorded.log, done)); !wrote) return wrote;
  if (auto wrote = base::replace_file(out / "report.json", base::to_text(report, 2) + "\n"); !wrote) return wrote;
  if (poses.empty())
    return base::fail(base::ErrorKind::lost, "no place on the map fits the scans, or several fit alike",
                      "say where the robot began: --start x,y,heading");
  print_summary(report);
  return {};
}

}  // namespace lapwing::apps
