#pragma once

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

/// What every peer reads and writes, so that all of them get the same scans and are judged by the same poses.
namespace lapwing::bench {

struct PlanarPose {
  double x = 0.0;
  double y = 0.0;
  double yaw = 0.0;
};

inline PlanarPose between(PlanarPose const& a, PlanarPose const& b) {
  auto const x = b.x - a.x;
  auto const y = b.y - a.y;
  return {std::cos(a.yaw) * x + std::sin(a.yaw) * y, -std::sin(a.yaw) * x + std::cos(a.yaw) * y, b.yaw - a.yaw};
}

inline PlanarPose after(PlanarPose const& a, PlanarPose const& step) {
  return {a.x + std::cos(a.yaw) * step.x - std::sin(a.yaw) * step.y,
          a.y + std::sin(a.yaw) * step.x + std::cos(a.yaw) * step.y, a.yaw + step.yaw};
}

struct Scan {
  double time = 0.0;  ///< s; later than the one before
  PlanarPose odometry;
  std::vector<double> ranges;
};

/// Of one laser that looks ahead.
struct Scans {
  int beams = 0;
  double first_rad = 0.0;
  double step_rad = 0.0;
  double nothing_m = 0.0;  ///< ranges from here on say that nothing came back
  double offset_m = 0.0;   ///< of the laser, along the robot
  std::vector<Scan> scans;
};

/// A line of the laser's numbers in that order, then one a scan: time, x, y, yaw, ranges. Ends the program where it
/// cannot be read.
inline Scans read_scans(char const* path) {
  std::ifstream file(path);
  Scans all;
  std::string line;
  if (!std::getline(file, line) ||
      !(std::istringstream(line) >> all.beams >> all.first_rad >> all.step_rad >> all.nothing_m >> all.offset_m)) {
    std::fprintf(stderr, "%s: no scans\n", path);
    std::exit(2);
  }
  while (std::getline(file, line)) {
    char* at = line.data();
    auto const next = [&] { return std::strtod(at, &at); };
    Scan scan{.time = next(), .odometry = {next(), next(), next()}, .ranges = {}};
    for (int k = 0; k < all.beams; ++k) scan.ranges.push_back(next());
    all.scans.push_back(std::move(scan));
  }
  return all;
}

/// A scan that the peer took as a node, and where it says that it was taken.
struct Node {
  std::size_t scan = 0;
  PlanarPose pose;
};

/// A pose for every scan: of the node that is nearest among the scans, and from there by odometry. `nodes` by scan, at
/// least one.
inline void write_poses(char const* path, Scans const& all, std::vector<Node> const& nodes) {
  std::ofstream file(path);
  file.precision(12);
  std::size_t n = 0;
  for (std::size_t k = 0; k < all.scans.size(); ++k) {
    auto const away = [&](Node const& node) { return node.scan > k ? node.scan - k : k - node.scan; };
    while (n + 1 < nodes.size() && away(nodes[n + 1]) < away(nodes[n])) ++n;
    auto const step = between(all.scans[nodes[n].scan].odometry, all.scans[k].odometry);
    auto const pose = after(nodes[n].pose, step);
    file << all.scans[k].time << ' ' << pose.x << ' ' << pose.y << ' ' << pose.yaw << '\n';
  }
}

}  // namespace lapwing::bench
