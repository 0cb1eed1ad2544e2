#include "slam/known/localizer.hpp"

#include <algorithm>
#include <cmath>

#include "slam/loops/branch_and_bound.hpp"

namespace lapwing::slam {
namespace {

constexpr double good_fit = 0.8;
constexpr double lost_fit = 0.7;
constexpr double lost_after_m = 1.0;
constexpr double lost_after_rad = 2.0;
constexpr double search_again_m = 2.0;       // and each time in vain twice as far,
constexpr double most_until_search_m = 8.0;  // up to this: where the map has nothing, searching takes a second
constexpr std::size_t most_search_points = 150;

Eigen::Vector3d trust_of(OdometryNoise::Spread const& spread) {
  auto const shift = 1.0 / (spread.shift_m * spread.shift_m);
  return {shift, shift, 1.0 / (spread.turn_rad * spread.turn_rad)};
}

std::vector<Eigen::Vector2f> some_of(std::vector<Eigen::Vector2f> const& points) {
  auto const stride = std::max<std::size_t>(1, points.size() / most_search_points);
  std::vector<Eigen::Vector2f> some;
  for (std::size_t k = 0; k < points.size(); k += stride) some.push_back(points[k]);
  return some;
}

}  // namespace

Laid Localizer::follow(Frame const& frame, Pose2 const& odometry) {
  auto const driven = between(odometry_, odometry);
  odometry_ = odometry;
  auto const guess = pose_ * driven;
  auto const spread = noise_.of(driven);
  Prior const prior{.pose = guess, .trust = trust_of(spread)};
  auto laid = lay_on_map(map_, frame, guess, prior);
  if (laid.fit < good_fit && !frame.points.empty()) {
    LoopWindow const around{.guess = guess,
                            .reach_m = std::clamp(5.0 * spread.shift_m, 0.4, 1.0),
                            .reach_rad = std::clamp(5.0 * spread.turn_rad, 0.2, 0.5),
                            .sigma_m = 3.0 * spread.shift_m,
                            .sigma_rad = 3.0 * spread.turn_rad};
    constexpr double any_score = 0.2;
    constexpr double clearly_better = 0.05;
    if (auto const found = branch_and_bound(map_.pyramid(), some_of(frame.points), around, any_score)) {
      auto const other = lay_on_map(map_, frame, found->pose, {.pose = found->pose, .trust = prior.trust});
      if (other.fit > laid.fit + clearly_better) laid = other;
    }
  }
  if (frame.points.empty()) laid = {.pose = guess, .fit = 0.0};
  if (laid.fit >= good_fit) noise_.learn(driven, guess, laid.pose, true);
  pose_ = laid.pose;
  return laid;
}

namespace {

/// How far it has gone since the scans began to fit badly.
class Doubt {
 public:
  /// Whether by now it is lost.
  bool tell(double fit, Pose2 const& motion) {
    if (fit >= lost_fit) {
      *this = {};
      return false;
    }
    ++scans_;
    path_m_ += std::hypot(motion.x, motion.y);
    turn_rad_ += std::abs(motion.yaw);
    return path_m_ > lost_after_m || turn_rad_ > lost_after_rad;
  }
  /// That fit badly, the last one among them.
  [[nodiscard]] std::size_t scans() const { return scans_; }

 private:
  std::size_t scans_ = 0;
  double path_m_ = 0.0;
  double turn_rad_ = 0.0;
};

class LogLocalizer {
 public:
  using Progress = std::function<void(std::string_view stage, double share)>;

  LogLocalizer(KnownMap const& map, ScanLog const& log, FrameOptions const& options, Progress const& progress)
      : map_(map), log_(log), options_(options), progress_(progress) {
    done_.scans.resize(log.scans.size());
  }

  Localization run(std::optional<Pose2> const& start) && {
    auto const count = log_.scans.size();
    std::size_t next = 0;
    if (start && count > 0) next = follow(*start, 0, 1);
    std::optional<Pose2> searched_at;
    double until_search_m = search_again_m;
    while (next < count) {
      auto const& odometry = log_.scans[next].odometry;
      if (searched_at && distance_m(*searched_at, odometry) < until_search_m) {
        ++next;
        continue;
      }
      searched_at = odometry;
      tell("searching", next);
      bool const was_found = start || done_.start;
      auto const found = find_start(map_, log_, next, options_);
      until_search_m = found ? search_again_m : std::min(2.0 * until_search_m, most_until_search_m);
      if (!found) continue;
      if (!was_found) done_.start = found;
      // What came before, too, as far back as nobody knows where it was.
      (void)follow(found->pose, next, -1);
      next = follow(found->pose, next, 1);
      searched_at.reset();
    }
    tell("done", count);
    return std::move(done_);
  }

 private:
  void tell(std::string_view stage, std::size_t scan) const {
    progress_(stage, static_cast<double>(scan) / static_cast<double>(std::max<std::size_t>(1, log_.scans.size())));
  }

  /// From a scan whose pose is known on, one way or the other, until the end, the lost or what is known already; the
  /// first that was not told.
  std::size_t follow(Pose2 const& pose, std::size_t first, int way) {
    Localizer localizer(map_, pose, log_.scans[first].odometry);
    Doubt doubt;
    auto last = log_.scans[first].odometry;
    auto i = first;
    for (; i < log_.scans.size() && (way > 0 || done_.scans[i].is_lost); i += static_cast<std::size_t>(way)) {
      tell("following", i);
      auto const& scan = log_.scans[i];
      auto const frame = frame_of(scan, log_.sensors[static_cast<std::size_t>(scan.sensor)], options_);
      auto const laid = localizer.follow(frame, scan.odometry);
      done_.scans[i] = {.pose = laid.pose, .fit = laid.fit, .is_lost = false};
      if (doubt.tell(laid.fit, between(last, scan.odometry))) {
        for (std::size_t back = 0; back < doubt.scans(); ++back)
          done_.scans[i - back * static_cast<std::size_t>(way)].is_lost = true;
        if (way > 0) ++done_.times_lost;
        return i + 1;
      }
      last = scan.odometry;
    }
    return i;
  }

  KnownMap const& map_;
  ScanLog const& log_;
  FrameOptions options_;
  Progress const& progress_;
  Localization done_;
};

}  // namespace

Localization localize_log(KnownMap const& map, ScanLog const& log, std::optional<Pose2> const& start,
                          FrameOptions const& options, std::function<void(std::string_view, double)> const& progress) {
  return LogLocalizer(map, log, options, progress).run(start);
}

}  // namespace lapwing::slam
