#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/slam/recorded_log.hpp"
#include "slam/relations.hpp"

/// What `lapwing map` tells of its work, whether it makes a map or lays scans on one.
namespace lapwing::apps {

/// How long each scan took while the robot was followed, by the calls that tell of progress before each.
class ScanTimes {
 public:
  void operator()(std::string_view stage);
  /// Milliseconds that so large a share of the scans did not exceed.
  [[nodiscard]] double percentile_ms(double share);

 private:
  std::optional<std::chrono::steady_clock::time_point> last_;
  std::vector<double> took_ms_;
};

/// On a terminal one line that changes; elsewhere a line a stage.
class ProgressLine {
 public:
  ProgressLine();
  void operator()(std::string_view stage, double share);

 private:
  bool is_terminal_;
  int percent_ = -1;
  std::string stage_;
};

/// `time x y z qx qy qz qw`, a line each.
[[nodiscard]] std::string tum_text(std::vector<slam::TimedPose> const& poses);

/// Both definitions of the trajectory's errors. Precondition: there are poses.
[[nodiscard]] nlohmann::ordered_json relations_json(std::vector<slam::TimedPose> const& poses,
                                                    std::vector<slam::Relation> const& relations);
[[nodiscard]] nlohmann::ordered_json bag_json(RecordedLog const& recorded);
/// Of one bag what it is, of several logs a list of the bags among them; null where there is none.
[[nodiscard]] nlohmann::ordered_json bags_json(std::vector<RecordedLog> const& recorded);

/// `wall_s`, `cpu_s`, `peak_mb` of the process and `scan_ms`.
void add_use(nlohmann::ordered_json& report, std::chrono::steady_clock::time_point started, ScanTimes& times);

}  // namespace lapwing::apps
