#include "slam/refine/fill.hpp"

#include <algorithm>

#include "base/assert.hpp"
#include "slam/match/align.hpp"
#include "slam/refine/overlap.hpp"

namespace lapwing::slam {
namespace {

/// The key frame before a scan and, if there is one, the next.
struct Around {
  int before;
  int after;
};

Around around(Graph const& graph, int scan) {
  auto const next = std::ranges::upper_bound(graph.frames, scan, {}, &KeyFrame::scan);
  auto const before = std::max(0, static_cast<int>(next - graph.frames.begin()) - 1);
  return {before, next == graph.frames.end() ? before : static_cast<int>(next - graph.frames.begin())};
}

/// Where odometry puts the scan: carried from the nearer key frame, or from the one before where odometry jumped on the
/// way to the next, for that one was taken right after the jump.
Pose2 carried(Graph const& graph, std::vector<Pose2> const& odometry, Around const& keys, int scan) {
  constexpr double jump_m = 1.0;
  constexpr double jump_rad = 0.5;
  auto const [before, after] = keys;
  auto const of_key = [&](int key) { return odometry[graph.frames[key].scan]; };
  auto const told = between(of_key(before), of_key(after));
  auto const mapped = between(graph.poses[before], graph.poses[after]);
  auto const has_jumped = distance_m(told, mapped) > jump_m || turn_rad(told, mapped) > jump_rad;
  auto const is_after_nearer =
      after != before && graph.frames[after].scan - scan < scan - graph.frames[before].scan && !has_jumped;
  auto const nearest = is_after_nearer ? after : before;
  return graph.poses[nearest] * between(of_key(nearest), odometry[scan]);
}

/// `share` of the way from one pose to the other.
Pose2 mixed(Pose2 const& from, Pose2 const& to, double share) {
  auto const step = between(from, to);
  return from * Pose2{share * step.x, share * step.y, share * step.yaw};
}

}  // namespace

std::vector<Pose2> spread_over_scans(std::vector<Pose2> const& odometry, Graph const& graph) {
  std::vector<Pose2> poses(odometry.size());
  if (graph.frames.empty()) return odometry;
  std::vector<double> path_m(odometry.size(), 0.0);
  for (std::size_t i = 1; i < odometry.size(); ++i) {
    constexpr double m_per_rad = 0.5;  // a robot that turns on the spot moves on, too
    path_m[i] =
        path_m[i - 1] + distance_m(odometry[i - 1], odometry[i]) + m_per_rad * turn_rad(odometry[i - 1], odometry[i]);
  }
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    auto const [before, after] = around(graph, static_cast<int>(i));
    auto const from = static_cast<std::size_t>(graph.frames[before].scan);
    auto const to = static_cast<std::size_t>(graph.frames[after].scan);
    auto const by_before = graph.poses[before] * between(odometry[from], odometry[i]);
    auto const by_after = graph.poses[after] * between(odometry[to], odometry[i]);
    auto const length = path_m[to] - path_m[from];
    poses[i] = length > 0.0 ? mixed(by_before, by_after, (path_m[i] - path_m[from]) / length) : by_before;
  }
  return poses;
}

std::vector<Pose2> fill(ScanLog const& log, std::vector<Pose2> const& odometry, Graph const& graph,
                        FrameOptions const& frame_options, FillOptions const& options, ForEach const& for_each) {
  LAPWING_ASSERT(odometry.size() == log.scans.size(), odometry.size(), log.scans.size());
  std::vector<Pose2> poses(log.scans.size());
  if (graph.frames.empty()) return poses;
  PlaceIndex const index(graph.poses, options.radius_m);
  for_each(log.scans.size(), [&](std::size_t i) {
    auto const scan = static_cast<int>(i);
    auto const keys = around(graph, scan);
    if (graph.frames[keys.before].scan == scan) {
      poses[i] = graph.poses[keys.before];
      return;
    }
    auto const start = carried(graph, odometry, keys, scan);
    std::vector<Target> targets;
    auto const lay_upon = [&](int key) { targets.push_back({&graph.frames[key].frame, graph.poses[key]}); };
    for (auto const key : index.near(start, -1, options.neighbours)) lay_upon(key);
    lay_upon(keys.before);
    if (keys.after != keys.before) lay_upon(keys.after);
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
