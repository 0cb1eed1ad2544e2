#include "robot/mapping/who_walks.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Core>

namespace lapwing::robot {

namespace {

constexpr double nearest_m = 0.5;   ///< on the way back: nearer ones see those who follow where they are now
constexpr double farthest_m = 4.0;  ///< what is farther off on the way has drifted, and sees less
constexpr double apart_m = 0.3;
constexpr float most_range_m = 4.0F;  ///< of a place from them: beyond, beams miss what is thin
constexpr float there_m = 0.2F;       ///< so near to a reading, and that is what it saw
constexpr float beyond_m = 0.3F;      ///< a reading so much farther saw floor
constexpr int enough = 2;             ///< key frames that saw floor there
constexpr double most_share = 0.25;   ///< of all readings: two people near by take less

/// A key frame, and the way into it.
struct Witness {
  slam::Frame const* frame;
  Eigen::Vector2d at;
  slam::Turn turn;
};

std::vector<Witness> witnesses(slam::Graph const& graph) {
  std::vector<Witness> found;
  double const here_m = graph.frames.back().path_m;
  double next_m = nearest_m;
  for (int k = graph.size() - 1; k >= 0; --k) {
    double const back_m = here_m - graph.frames[k].path_m;
    if (back_m > farthest_m) break;
    if (back_m < next_m) continue;
    found.push_back(
        {.frame = &graph.frames[k].frame, .at = slam::place(graph.poses[k]), .turn = slam::Turn(graph.poses[k].yaw)});
    next_m = back_m + apart_m;
  }
  return found;
}

enum class Saw { nothing_of_it, floor, something };

Saw what_saw(Witness const& witness, Eigen::Vector2d const& place) {
  auto const& frame = *witness.frame;
  Eigen::Vector2f const from_centre = witness.turn.back(place - witness.at).cast<float>() - frame.centre;
  float const range_m = from_centre.norm();
  if (range_m > most_range_m) return Saw::nothing_of_it;
  float const bearing = std::atan2(from_centre.y(), from_centre.x());
  int const bins = frame.bins();
  auto const bin = static_cast<int>(std::floor((bearing - frame.first_bearing) / frame.bin_width));
  bool is_floor = true;
  for (int const near : {bin - 1, bin, bin + 1}) {
    int const at = frame.goes_round ? ((near % bins) + bins) % bins : near;
    float const seen_m = at >= 0 && at < bins ? frame.free_of_bin[static_cast<std::size_t>(at)] : 0.0F;
    if (seen_m > 0.0F && std::abs(seen_m - range_m) < there_m) return Saw::something;
    is_floor = is_floor && seen_m > range_m + beyond_m;
  }
  return is_floor ? Saw::floor : Saw::nothing_of_it;
}

bool walks(std::vector<Witness> const& witnesses, Eigen::Vector2d const& place) {
  int saw_floor = 0;
  for (auto const& witness : witnesses) {
    auto const saw = what_saw(witness, place);
    if (saw == Saw::something) return false;
    saw_floor += saw == Saw::floor ? 1 : 0;
  }
  return saw_floor >= enough;
}

}  // namespace

slam::Scan without_who_walks(slam::Scan const& scan, slam::Sensor const& sensor, slam::Pose2 const& pose,
                             slam::Graph const& graph) {
  if (graph.frames.empty()) return scan;
  auto const known = witnesses(graph);
  auto rest = scan;
  slam::Turn const turn(pose.yaw);
  Eigen::Vector2d const mount = sensor.mount_m.cast<double>();
  auto const& bearings = bearings_of(scan, sensor);
  int all = 0;
  int gone = 0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (!sensor.is_reading(scan.ranges_m[i])) continue;
    double const range_m = scan.ranges_m[i];
    ++all;
    double const bearing = bearings[i];
    Eigen::Vector2d const end = mount + range_m * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    if (!walks(known, slam::place(pose) + turn * end)) continue;
    rest.ranges_m[i] = 0.0F;
    ++gone;
  }
  return gone > most_share * all ? scan : rest;
}

}  // namespace lapwing::robot
