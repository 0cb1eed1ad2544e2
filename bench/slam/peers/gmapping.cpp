// GMapping (openslam_gmapping) as a program: SCANS OUT. Its settings are those of its own gfs-LMS-5cm.ini.
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <gmapping/gridfastslam/gridslamprocessor.h>
#include <gmapping/sensor/sensor_range/rangesensor.h>
#include <gmapping/utils/stat.h>

#include "scans.hpp"

int main(int, char** words) {
  using namespace lapwing::bench;
  auto const all = read_scans(words[1]);
  constexpr double most_m = 81.0;
  constexpr double used_m = 80.0;
  GMapping::sampleGaussian(1, 1);  // seeds it
  srand48(1);
  std::srand(1);

  GMapping::RangeSensor laser("FLASER", static_cast<unsigned>(all.beams), all.step_rad,
                              GMapping::OrientedPoint(all.offset_m, 0, 0), 0, most_m);
  for (int k = 0; k < all.beams; ++k) laser.beams()[k].pose.theta = all.first_rad + all.step_rad * k;
  laser.updateBeamsLookup();
  std::ofstream nowhere("/dev/null");
  std::cerr.rdbuf(nowhere.rdbuf());
  GMapping::GridSlamProcessor slam(nowhere);
  slam.setSensorMap({{laser.getName(), &laser}});
  slam.setMatchingParameters(used_m, most_m, 0.05, 1, 0.05, 0.05, 5, 0.05, 3, 0);
  slam.setMotionModelParameters(0.1, 0.1, 0.1, 0.1);
  slam.setUpdateDistances(1.0, 0.5, 0.5);
  slam.setUpdatePeriod(-1);
  slam.setgenerateMap(false);
  auto const& first = all.scans.front().odometry;
  slam.init(30, first.x - 100, first.y - 100, first.x + 100, first.y + 100, 0.05,
            GMapping::OrientedPoint(first.x, first.y, first.yaw));
  slam.setllsamplerange(0.05);
  slam.setllsamplestep(0.05);
  slam.setlasamplerange(0.05);
  slam.setlasamplestep(0.05);
  slam.setminimumScore(0);

  for (auto const& scan : all.scans) {
    auto ranges = scan.ranges;
    for (auto& range : ranges)
      if (range >= all.nothing_m || range > most_m) range = most_m + 1;
    GMapping::RangeReading reading(static_cast<unsigned>(all.beams), ranges.data(), &laser, scan.time);
    reading.setPose(GMapping::OrientedPoint(scan.odometry.x, scan.odometry.y, scan.odometry.yaw));
    slam.processScan(reading);
  }
  std::vector<Node> nodes;
  auto const& best = slam.getParticles()[static_cast<std::size_t>(slam.getBestParticleIndex())];
  for (auto const* node = best.node; node != nullptr; node = node->parent) {
    if (node->reading == nullptr) continue;
    auto const at = std::ranges::lower_bound(all.scans, node->reading->getTime() - 1e-6, {}, &Scan::time);
    nodes.push_back({static_cast<std::size_t>(at - all.scans.begin()), {node->pose.x, node->pose.y, node->pose.theta}});
  }
  std::ranges::reverse(nodes);
  write_poses(words[2], all, nodes);
  std::_Exit(0);  // it does not end well by itself
}
