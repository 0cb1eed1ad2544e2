#include "apps/slam/map_report.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace lapwing::apps {

namespace {

using Json = nlohmann::ordered_json;

Json spread_json(slam::Spread const& spread) {
  return {{"mean", spread.mean}, {"std", spread.deviation}, {"mean_square", spread.mean_square}, {"max", spread.most}};
}
Json errors_json(slam::RelationErrors const& errors) {
  return {{"translation_m", spread_json(errors.shift_m)}, {"rotation_deg", spread_json(errors.turn_deg)}};
}

double cpu_s() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  auto const seconds = [](timeval const& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}
double peak_mb() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_maxrss) / 1024.0;
}

}  // namespace

void ScanTimes::operator()(std::string_view stage) {
  auto const now = std::chrono::steady_clock::now();
  if (last_) took_ms_.push_back(std::chrono::duration<double, std::milli>(now - *last_).count());
  last_ = stage == "following" ? std::optional(now) : std::nullopt;
}

double ScanTimes::percentile_ms(double share) {
  if (took_ms_.empty()) return 0.0;
  std::ranges::sort(took_ms_);
  return took_ms_[static_cast<std::size_t>(share * static_cast<double>(took_ms_.size() - 1))];
}

ProgressLine::ProgressLine() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::operator()(std::string_view stage, double share) {
  auto const percent = static_cast<int>(share * 100.0);
  if (is_terminal_) {
    if (percent == percent_) return;
    fmt::print(stderr, "\r\033[K{:3} % {}", percent, stage);
    if (percent == 100) fmt::print(stderr, "\r\033[K");
  } else if (stage != stage_) {
    fmt::print(stderr, "{:3} % {}\n", percent, stage);
  }
  percent_ = percent;
  stage_ = stage;
}

std::string tum_text(std::vector<slam::TimedPose> const& poses) {
  std::string text;
  for (auto const& [time, pose] : poses)
    fmt::format_to(std::back_inserter(text), "{:.6f} {:.6f} {:.6f} 0 0 0 {:.9f} {:.9f}\n", time.count(), pose.x, pose.y,
                   std::sin(0.5 * pose.yaw), std::cos(0.5 * pose.yaw));
  return text;
}

Json relations_json(std::vector<slam::TimedPose> const& poses, std::vector<slam::Relation> const& relations) {
  return {{"count", relations.size()},
          {"component", errors_json(slam::component_errors(poses, relations))},
          {"motion", errors_json(slam::motion_errors(poses, relations))}};
}

Json bag_json(RecordedLog const& recorded) {
  return {{"scan_topic", recorded.scan_topic}, {"odometry", recorded.odometry}, {"remarks", recorded.remarks}};
}

Json bags_json(std::vector<RecordedLog> const& recorded) {
  Json bags;
  for (auto const& one : recorded)
    if (!one.scan_topic.empty()) bags.push_back(bag_json(one));
  return recorded.size() == 1 && !bags.is_null() ? bags[0] : bags;
}

void add_use(Json& report, std::chrono::steady_clock::time_point started, ScanTimes& times) {
  report["wall_s"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  report["cpu_s"] = cpu_s();
  report["peak_mb"] = peak_mb();
  report["scan_ms"] = {
      {"p50", times.percentile_ms(0.5)}, {"p99", times.percentile_ms(0.99)}, {"max", times.percentile_ms(1.0)}};
}

}  // namespace lapwing::apps
