#include "slam/known/find_start.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "slam/known/lay_on_map.hpp"
#include "slam/loops/branch_and_bound.hpp"

namespace lapwing::slam {
namespace {

constexpr double step_m = 0.4;
constexpr double step_rad = 0.3;
/// So many scans, a step apart, and what is asked of them. Few fit well even where odometry is poor, but corridors of
/// any building look alike for some metres: one alone must leave no doubt.
struct Attempt {
  std::size_t scans = 0;
  double most_rival = 0.92;  ///< the score of the best place elsewhere, as a share of the best
  double least_fit = 0.9;    ///< once the scans are laid on the walls
};
constexpr std::array<Attempt, 4> attempts = {Attempt{1, 0.8, 0.95}, Attempt{3}, Attempt{10}, Attempt{30}};
constexpr std::size_t most_points = 160;
constexpr double least_score = 0.6;  // of the search, whose steps are coarse

/// Evenly, so that no scan of several counts for less than another.
std::vector<Eigen::Vector2f> thinned(std::vector<Eigen::Vector2f> const& points) {
  auto const stride = std::max<std::size_t>(1, (points.size() + most_points - 1) / most_points);
  std::vector<Eigen::Vector2f> some;
  for (std::size_t k = 0; k < points.size(); k += stride) some.push_back(points[k]);
  return some;
}

/// Points of scans a step apart, in the frame of the first.
class Joined {
 public:
  Joined(ScanLog const& log, std::size_t first, FrameOptions const& options)
      : log_(log), options_(options), next_(first), first_(log.scans[first].odometry), last_(first_) {
    take();
  }
  /// Until there are as many scans; false: the log has no more.
  bool grow_to(std::size_t scans) {
    while (scans_ < scans && next_ < log_.scans.size()) {
      auto const& odometry = log_.scans[next_].odometry;
      if (distance_m(last_, odometry) < step_m && turn_rad(last_, odometry) < step_rad) {
        ++next_;
      } else {
        take();
      }
    }
    return scans_ >= scans;
  }
  [[nodiscard]] std::vector<Eigen::Vector2f> const& points() const { return points_; }
  [[nodiscard]] std::size_t scans() const { return scans_; }

 private:
  void take() {
    auto const& scan = log_.scans[next_++];
    last_ = scan.odometry;
    auto const frame = frame_of(scan, log_.sensors[static_cast<std::size_t>(scan.sensor)], options_);
    auto const from_first = between(first_, last_);
    Turn const turn(from_first.yaw);
    for (auto const& point : frame.points)
      points_.push_back((place(from_first) + turn * point.cast<double>()).cast<float>());
    ++scans_;
  }

  ScanLog const& log_;
  FrameOptions options_;
  std::size_t next_;
  Pose2 first_;
  Pose2 last_;
  std::size_t scans_ = 0;
  std::vector<Eigen::Vector2f> points_;
};

}  // namespace

std::optional<FoundStart> find_start(KnownMap const& map, ScanLog const& log, std::size_t scan,
                                     FrameOptions const& options) {
  LoopWindow const everywhere{
      .guess = {map.middle().x(), map.middle().y(), 0.0}, .reach_m = map.half_side_m(), .reach_rad = std::numbers::pi};
  Joined joined(log, scan, options);
  for (auto const& attempt : attempts) {
    bool const has_more = joined.grow_to(attempt.scans);
    auto const found = branch_and_bound(map.pyramid(), thinned(joined.points()), everywhere, least_score);
    if (found && found->rival < attempt.most_rival * found->score) {
      Frame frame;
      frame.points = joined.points();
      auto const laid = lay_on_map(map, frame, found->pose, {.pose = found->pose});
      if (laid.fit >= attempt.least_fit)
        return FoundStart{.pose = laid.pose, .score = found->score, .rival = found->rival, .scans = joined.scans()};
    }
    if (!has_more) break;
  }
  return std::nullopt;
}

}  // namespace lapwing::slam
