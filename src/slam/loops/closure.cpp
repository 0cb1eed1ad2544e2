#include "slam/loops/closure.hpp"

#include <array>
#include <unordered_set>

#include <Eigen/Dense>

#include "slam/match/point_to_line.hpp"

namespace lapwing::slam {
namespace {

/// The three key frames of a query that are aligned together, as steps back from its last.
constexpr std::array query_steps{0, 1, 2};
/// The five of a submap, around its reference.
constexpr std::array target_steps{-2, -1, 0, 1, 2};

struct Alignment {
  Pose2 pose;  ///< of the query's last key frame, in the map
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  int matches = 0;
};

bool is_of(Graph const& graph, int frame) {
  return frame >= 0 && frame < graph.size();
}

/// Two places, each as a key frame and how far apart those are that are taken around it.
struct Places {
  int target;
  int query;
  int step;

  /// Whether the key frame is of the query's own surroundings.
  [[nodiscard]] bool is_near_query(int frame) const { return std::abs(frame - query) < 3 * step + 1; }
};

/// One round of Gauss-Newton over all pairs of the query's and the target's key frames, the query's rigid.
Alignment accumulate(Graph const& graph, Places const& places, Pose2 const& pose, Association const& association,
                     Eigen::Vector3d& gradient) {
  auto const [target, query, apart] = places;
  Alignment sum{.pose = pose};
  gradient.setZero();
  for (auto const back : query_steps) {
    auto const source = query - back * apart;
    if (!is_of(graph, source)) continue;
    auto const source_pose = pose * between(graph.poses[query], graph.poses[source]);
    Eigen::Matrix3d by_query = Eigen::Matrix3d::Identity();  // how the source moves when the query's last one does
    by_query(0, 2) = -(source_pose.y - pose.y);
    by_query(1, 2) = source_pose.x - pose.x;
    for (auto const step : target_steps) {
      auto const frame = target + step * apart;
      if (!is_of(graph, frame) || places.is_near_query(frame)) continue;
      auto const term = point_to_line(graph.frames[source].frame, source_pose, graph.frames[frame].frame,
                                      graph.poses[frame], association);
      if (!term.is_usable()) continue;
      sum.hessian += by_query.transpose() * term.hessian.topLeftCorner<3, 3>() * by_query;
      gradient += by_query.transpose() * term.gradient.head<3>();
      sum.matches += term.matches;
    }
  }
  return sum;
}

Alignment align(Graph const& graph, Places const& places, Pose2 const& pose) {
  constexpr int rounds = 8;
  constexpr Association wide{.gate_m = 0.3, .scale_m = 0.1};
  constexpr Association narrow{.gate_m = 0.12, .scale_m = 0.04};
  constexpr int hopeless = 40;
  Alignment result{.pose = pose};
  for (int round = 0; round < rounds; ++round) {
    Eigen::Vector3d gradient;
    auto sum = accumulate(graph, places, result.pose, round < 3 ? wide : narrow, gradient);
    if (sum.matches < hopeless) return sum;
    // Along a corridor nothing holds the query: there it stays where the search put it.
    Eigen::Matrix3d damped = sum.hessian;
    damped.diagonal() += Eigen::Vector3d(0.4, 0.4, 1.6);
    Eigen::Vector3d const step = damped.ldlt().solve(-gradient);
    sum.pose = stepped(result.pose, step);
    result = sum;
    if (round >= 3 && step.norm() < 5e-4) break;
  }
  return result;
}

Agreement look_through(Graph const& graph, Places const& places, Pose2 const& pose) {
  auto const [target, query, apart] = places;
  Agreement sum;
  for (auto const back : query_steps) {
    auto const source = query - back * apart;
    if (!is_of(graph, source)) continue;
    auto const source_pose = pose * between(graph.poses[query], graph.poses[source]);
    for (auto const step : target_steps) {
      auto const frame = target + step * apart;
      if (!is_of(graph, frame) || places.is_near_query(frame)) continue;
      sum += agreement(graph.frames[source].frame, source_pose, graph.frames[frame].frame, graph.poses[frame]);
    }
  }
  return sum;
}

}  // namespace

std::optional<Submap> make_submap(Graph const& graph, int first, int last) {
  constexpr float most_range_m = 15.0F;
  constexpr std::size_t least_points = 50;
  auto const reference = first + (last - first + 1) / 2;
  std::vector<Eigen::Vector2f> points;
  for (int k = first; k <= last; ++k) {
    auto const at = between(graph.poses[reference], graph.poses[k]);
    Turn const turn(at.yaw);
    auto const& frame = graph.frames[k].frame;
    for (std::size_t p = 0; p < frame.points.size(); ++p)
      if (frame.ranges[p] < most_range_m)
        points.emplace_back((place(at) + turn * frame.points[p].cast<double>()).cast<float>());
  }
  if (points.size() < least_points) return std::nullopt;
  return Submap{.reference = reference, .first = first, .last = last, .pyramid = Pyramid(points)};
}

std::vector<Eigen::Vector2f> query_cloud(Graph const& graph, int last, int frames) {
  constexpr float most_range_m = 12.0F;
  constexpr float cell_m = 0.2F;
  std::vector<Eigen::Vector2f> points;
  std::unordered_set<std::int64_t> taken;
  for (int k = last; k >= std::max(0, last - frames + 1); --k) {
    auto const at = between(graph.poses[last], graph.poses[k]);
    Turn const turn(at.yaw);
    auto const& frame = graph.frames[k].frame;
    for (std::size_t p = 0; p < frame.points.size(); ++p) {
      if (frame.ranges[p] > most_range_m) continue;
      Eigen::Vector2f const point = (place(at) + turn * frame.points[p].cast<double>()).cast<float>();
      auto const x = static_cast<std::int64_t>(std::floor(point.x() / cell_m));
      auto const y = static_cast<std::int64_t>(std::floor(point.y() / cell_m));
      if (taken.insert(x * 1'000'003 + y).second) points.push_back(point);
    }
    if (graph.frames[k].is_cut) break;
  }
  return points;
}

Closure make_closure(Graph const& graph, Submap const& submap, int query, LoopMatch const& match,
                     LoopOptions const& options) {
  auto const target = submap.reference;
  Places const places{.target = target, .query = query, .step = options.step_frames};
  auto const aligned = align(graph, places, graph.poses[target] * match.pose);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(-graph.poses[target].yaw).toRotationMatrix();
  return {.target = target,
          .query = query,
          .target_to_query = between(graph.poses[target], aligned.pose),
          .information = options.point_information * turn * aligned.hessian * turn.transpose(),
          .score = match.score,
          .rival = match.rival,
          .matches = aligned.matches,
          .agreement = look_through(graph, places, aligned.pose)};
}

}  // namespace lapwing::slam
