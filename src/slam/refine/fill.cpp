#include "slam/refine/fill.hpp"

#include <algorithm>

#include <Eigen/Dense>

#include "slam/match/point_to_line.hpp"
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

Pose2 align(Frame const& frame, Pose2 const& start, Graph const& graph, std::vector<int> const& targets,
            double point_information) {
  constexpr int rounds = 4;
  constexpr Association wide{.gate_m = 0.25, .scale_m = 0.08};
  constexpr Association narrow{.gate_m = 0.12, .scale_m = 0.03};
  Eigen::Vector3d const trust(400.0, 400.0, 2500.0);  // in odometry, over a part of a key frame's step
  auto pose = start;
  for (int round = 0; round < rounds; ++round) {
    Eigen::Matrix3d hessian = trust.asDiagonal();
    Eigen::Vector3d off = numbers(pose) - numbers(start);
    off.z() = geo::wrap_pi(off.z());
    Eigen::Vector3d gradient = trust.cwiseProduct(off);
    for (auto const target : targets) {
      auto const term =
          point_to_line(frame, pose, graph.frames[target].frame, graph.poses[target], round < 1 ? wide : narrow);
      if (!term.is_usable()) continue;
      hessian += point_information * term.hessian.topLeftCorner<3, 3>();
      gradient += point_information * term.gradient.head<3>();
    }
    Eigen::Vector3d const step = hessian.ldlt().solve(-gradient);
    pose = stepped(pose, step);
    if (step.norm() < 1e-3) break;
  }
  return pose;
}

}  // namespace

std::vector<Pose2> fill(ScanLog const& log, Graph const& graph, FrameOptions const& frame_options,
                        FillOptions const& options, ForEach const& for_each) {
  std::vector<Pose2> poses(log.scans.size());
  if (graph.frames.empty()) return poses;
  PlaceIndex const index(graph.poses, options.radius_m);
  for_each(log.scans.size(), [&](std::size_t i) {
    auto const scan = static_cast<int>(i);
    auto const [before, after] = around(graph, scan);
    if (graph.frames[before].scan == scan) {
      poses[i] = graph.poses[before];
      return;
    }
    auto const nearest =
        graph.frames[after].scan - scan < scan - graph.frames[before].scan && after != before ? after : before;
    auto const& key = log.scans[graph.frames[nearest].scan];
    auto const start = graph.poses[nearest] * between(key.odometry, log.scans[i].odometry);
    auto targets = index.near(start, -1, options.neighbours);
    targets.push_back(before);
    if (after != before) targets.push_back(after);
    auto const frame = frame_of(log.scans[i], log.sensors[log.scans[i].sensor], frame_options);
    poses[i] = align(frame, start, graph, targets, options.point_information);
  });
  return poses;
}

}  // namespace lapwing::slam
