#include "slam/graph/marginalize.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <Eigen/Dense>

#include "slam/graph/pose_graph.hpp"
#include "slam/graph/relative_pose.hpp"

namespace lapwing::slam {
namespace {

/// A neighbour as the key frame measured it.
struct Neighbour {
  int frame = 0;
  Pose2 pose;  ///< in the key frame's frame
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  bool is_loop = true;  ///< nothing but loops joins them
};

/// Along a corridor a loop says nothing of one direction. Tens of metres are as good as nothing, and can be inverted.
Eigen::Matrix3d covariance_of(Eigen::Matrix3d information) {
  constexpr double next_to_nothing = 1e-3;
  information.diagonal().array() += next_to_nothing;
  return information.inverse();
}

double log_determinant(Eigen::Matrix3d const& information) {
  constexpr double next_to_nothing = 1e-3;
  Eigen::Matrix3d some = information;
  some.diagonal().array() += next_to_nothing;
  return std::log(std::max(some.determinant(), 1e-300));
}

/// The measurement with the ends exchanged.
Constraint reversed(Constraint const& constraint) {
  // The pose of the origin as seen from `from_to`, by how that one moves.
  auto const slopes = relative_pose_slopes(constraint.from_to, Pose2{});
  Eigen::Matrix3d const covariance =
      slopes.by_from * covariance_of(constraint.information) * slopes.by_from.transpose();
  return {.from = constraint.to,
          .to = constraint.from,
          .from_to = inverse(constraint.from_to),
          .information = covariance.inverse(),
          .is_loop = constraint.is_loop};
}

/// Two measurements of one pose as one.
void take_in(Pose2& pose, Eigen::Matrix3d& information, Pose2 const& other, Eigen::Matrix3d const& other_information) {
  Eigen::Vector3d apart = numbers(other) - numbers(pose);
  apart.z() = geo::wrap_pi(apart.z());
  information += other_information;
  pose = stepped(pose, covariance_of(information) * other_information * apart);
}

bool is_open(Constraint const& constraint, std::vector<Pose2> const& poses) {
  constexpr double most_shift_m = 0.3;
  constexpr double most_turn = 0.05;
  auto const error = error_of(constraint, poses);
  return constraint.is_loop && (error.head<2>().norm() > most_shift_m || std::abs(error.z()) > most_turn);
}

void add(std::map<int, Neighbour>& neighbours, Constraint const& measured) {
  auto& neighbour =
      neighbours.try_emplace(measured.to, Neighbour{.frame = measured.to, .pose = measured.from_to}).first->second;
  take_in(neighbour.pose, neighbour.information, measured.from_to, measured.information);
  neighbour.is_loop = neighbour.is_loop && measured.is_loop;
}

/// What two neighbours know of each other over the key frame: their errors are independent, given where it stands.
Constraint joint(Neighbour const& a, Neighbour const& b) {
  auto const [by_a, by_b] = relative_pose_slopes(a.pose, b.pose);
  Eigen::Matrix3d const covariance =
      by_a * covariance_of(a.information) * by_a.transpose() + by_b * covariance_of(b.information) * by_b.transpose();
  Eigen::Matrix3d const information = covariance.inverse();
  return {.from = a.frame,
          .to = b.frame,
          .from_to = between(a.pose, b.pose),
          .information = 0.5 * (information + information.transpose()),
          .is_loop = a.is_loop || b.is_loop};
}

/// The spanning tree of the most information, those first that are no loops, then those between frames that stay
/// (Kruskal 1956). The determinant of the whole is the product of those of a tree's edges, whichever tree it is.
std::vector<Constraint> best_tree(std::vector<Neighbour> const& neighbours, std::vector<bool> const& goes) {
  struct Edge {
    std::size_t a;
    std::size_t b;
    bool lasts;  ///< both ends stay
    double gain;
    Constraint constraint;
  };
  std::vector<Edge> edges;
  for (std::size_t a = 0; a < neighbours.size(); ++a) {
    for (std::size_t b = a + 1; b < neighbours.size(); ++b) {
      auto const constraint = joint(neighbours[a], neighbours[b]);
      bool const lasts = !goes[neighbours[a].frame] && !goes[neighbours[b].frame];
      edges.push_back({a, b, lasts, log_determinant(constraint.information), constraint});
    }
  }
  std::ranges::sort(edges, {},
                    [](Edge const& e) { return std::tuple(e.constraint.is_loop, !e.lasts, -e.gain, e.a, e.b); });
  std::vector<std::size_t> part(neighbours.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  std::vector<Constraint> tree;
  for (auto const& edge : edges) {
    if (part[edge.a] == part[edge.b]) continue;
    tree.push_back(edge.constraint);
    auto const [into, from] = std::pair(part[edge.a], part[edge.b]);  // no references: `from` is replaced, too
    std::ranges::replace(part, from, into);
  }
  return tree;
}

/// One edge more; together with one of its kind that joins the same two.
void put(std::vector<Constraint>& constraints, Constraint const& edge) {
  auto const same = std::ranges::find_if(constraints, [&](Constraint const& c) {
    return c.is_loop == edge.is_loop && std::minmax(c.from, c.to) == std::minmax(edge.from, edge.to);
  });
  if (same == constraints.end()) {
    constraints.push_back(edge);
    return;
  }
  auto const turned = same->from == edge.from ? edge : reversed(edge);
  take_in(same->from_to, same->information, turned.from_to, turned.information);
}

void keep_best_loops(std::vector<Constraint>& constraints, int frame, int most) {
  std::vector<std::pair<double, std::size_t>> loops;
  for (std::size_t c = 0; c < constraints.size(); ++c)
    if (constraints[c].is_loop && (constraints[c].from == frame || constraints[c].to == frame))
      loops.emplace_back(log_determinant(constraints[c].information), c);
  if (static_cast<int>(loops.size()) <= most) return;
  std::ranges::sort(loops, std::greater<>());
  std::vector<std::size_t> worst;
  for (auto i = static_cast<std::size_t>(most); i < loops.size(); ++i) worst.push_back(loops[i].second);
  std::ranges::sort(worst, std::greater<>());
  for (auto const c : worst) constraints.erase(constraints.begin() + static_cast<std::ptrdiff_t>(c));
}

}  // namespace

std::vector<Constraint> marginalized(std::vector<Constraint> const& constraints, std::vector<Pose2> const& poses,
                                     int frame, std::vector<bool> const& goes, int most_loops) {
  std::vector<Constraint> left;
  std::map<int, Neighbour> by_frame;
  for (auto const& constraint : constraints) {
    if (constraint.from != frame && constraint.to != frame) {
      left.push_back(constraint);
    } else if (!is_open(constraint, poses)) {
      add(by_frame, constraint.from == frame ? constraint : reversed(constraint));
    }
  }
  std::vector<Neighbour> neighbours;
  for (auto const& [number, neighbour] : by_frame) neighbours.push_back(neighbour);
  for (auto const& edge : best_tree(neighbours, goes)) put(left, edge);
  for (auto const& neighbour : neighbours) keep_best_loops(left, neighbour.frame, most_loops);
  return left;
}

}  // namespace lapwing::slam
