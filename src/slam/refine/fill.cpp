#include "slam/refine/fill.hpp"

#include <algorithm>

#include "base/assert.hpp"
#include "slam/match/align.hpp"
#include "slam/refine/overlap.hpp"

namespace lapwing::slam {
namespace {

/// The way point before a scan and, if there is one, the next.
struct Around {
  WayPoint before;
  WayPoint after;
};

Around around(std::vector<WayPoint> const& way, int scan) {
  auto const next = std::ranges::upper_bound(way, scan, {}, &WayPoint::scan);
  auto const& before = way_point_before(way, scan);
  return {before, next == way.end() ? before : *next};
}

/// Where odometry puts the scan: carried from the nearer way point. Where it says something else than the map of how
/// the robot got from one to the other, it went evenly; if that was far, as in a gap of a recording, it stayed at the
/// one before, for the one after was taken right after the gap.
Pose2 carried(std::vector<Pose2> const& odometry, Around const& keys, int scan) {
  constexpr double wrong_m = 0.15;
  constexpr double wrong_rad = 0.1;
  constexpr double far_m = 2.0;  // farther than wheels are found to slip
  constexpr double far_rad = 1.0;
  auto const& [before, after] = keys;
  auto const told = between(odometry[before.scan], odometry[after.scan]);
  auto const mapped = between(before.pose, after.pose);
  auto const is_wrong = distance_m(told, mapped) > wrong_m || turn_rad(told, mapped) > wrong_rad;
  auto const is_far = distance_m(before.pose, after.pose) > far_m || turn_rad(before.pose, after.pose) > far_rad;
  if (is_wrong && !is_far)
    return on_the_way(before.pose, after.pose, static_cast<double>(scan - before.scan) / (after.scan - before.scan));
  auto const is_after_nearer = after.scan != before.scan && after.scan - scan < scan - before.scan && !is_wrong;
  auto const& nearest = is_after_nearer ? after : before;
  return nearest.pose * between(odometry[nearest.scan], odometry[scan]);
}

}  // namespace

std::vector<WayPoint> way_of(Graph const& graph) {
  std::vector<WayPoint> way;
  for (int k = 0; k < graph.size(); ++k)
    way.push_back({.scan = graph.frames[k].scan, .frame = k, .pose = graph.poses[k]});
  return way;
}

WayPoint const& way_point_before(std::vector<WayPoint> const& way, int scan) {
  LAPWING_ASSERT(!way.empty());
  auto const next = std::ranges::upper_bound(way, scan, {}, &WayPoint::scan);
  return next == way.begin() ? way.front() : *(next - 1);
}

std::vector<Pose2> spread_over_scans(std::vector<Pose2> const& odometry, Graph const& graph) {
  std::vector<Pose2> poses(odometry.size());
  if (graph.frames.empty()) return odometry;
  auto const way = way_of(graph);
  std::vector<double> path_m(odometry.size(), 0.0);
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    constexpr double m_per_rad = 0.5;  // a robot that turns on the spot moves on, too
    path_m[i] =
        path_m[i - 1] + distance_m(odometry[i - 1], odometry[i]) + m_per_rad * turn_rad(odometry[i - 1], odometry[i]);
  }
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    auto const [before, after] = around(way, static_cast<int>(i));
    auto const from = static_cast<std::size_t>(before.scan);
    auto const to = static_cast<std::size_t>(after.scan);
    auto const by_before = before.pose * between(odometry[from], odometry[i]);
    auto const by_after = after.pose * between(odometry[to], odometry[i]);
    auto const length = path_m[to] - path_m[from];
    poses[i] = length > 0.0 ? on_the_way(by_before, by_after, (path_m[i] - path_m[from]) / length) : by_before;
  }
  return poses;
}

std::vector<Pose2> fill(ScanLog const& log, std::vector<Pose2> const& odometry, std::vector<WayPoint> const& way,
                        Graph const& graph, FrameOptions const& frame_options, FillOptions const& options,
                        ForEach const& for_each) {
  LAPWING_ASSERT(odometry.size() == log.scans.size(), odometry.size(), log.scans.size());
  std::vector<Pose2> poses(log.scans.size());
  if (way.empty()) return poses;
  PlaceIndex const index(graph.poses, options.radius_m);
  for_each(log.scans.size(), [&](std::size_t i) {
    auto const scan = static_cast<int>(i);
    auto const keys = around(way, scan);
    if (keys.before.scan == scan && keys.before.is_key) {
      poses[i] = keys.before.pose;
      return;
    }
    auto const start = carried(odometry, keys, scan);
    std::vector<Target> targets;
    auto const lay_upon = [&](int key) { targets.push_back({&graph.frames[key].frame, graph.poses[key]}); };
    for (auto const key : index.near(start, -1, options.neighbours)) lay_upon(key);
    lay_upon(keys.before.frame);
    if (keys.after != keys.before) lay_upon(keys.after.frame);
    auto const frame = frame_of(log.scans[i], log.sensors[log.scans[i].sensor], frame_options);
    Eigen::Vector3d const trust(400.0, 400.0, 2500.0);  // in odometry, over a part of a key frame's step
    poses[i] =
        align(frame, start, {.pose = start, .trust = trust}, targets,
              {.rounds = 4, .wide_rounds = 1, .point_information = options.point_information, .stride = options.stride})
            .pose;
  });
  return poses;
}

}  // namespace lapwing::slam
