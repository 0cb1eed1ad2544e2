#include "slam/scan/gather.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "slam/scan/line_through.hpp"

namespace lapwing::slam {
namespace {

constexpr float round = 2.0F * std::numbers::pi_v<float>;
constexpr int bins = 180;

struct Seen {
  Eigen::Vector2f at;
  Eigen::Vector2f from;
  float bearing;
};

/// The normals of the lines through those that lie around, whoever saw them.
void find_normals(Frame& frame, std::vector<Seen> const& seen) {
  constexpr float radius_m = 0.35F;
  constexpr int least = 4;
  frame.normals.assign(seen.size(), Eigen::Vector2f::Zero());
  std::vector<Eigen::Vector2f> near;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    near.clear();
    for (auto const& other : seen)
      if ((other.at - seen[k].at).squaredNorm() <= radius_m * radius_m) near.push_back(other.at);
    if (static_cast<int>(near.size()) < least) continue;
    auto const line = line_through(near.data(), static_cast<int>(near.size()));
    if (!line.is_one) continue;
    frame.normals[k] = line.normal.dot(seen[k].at - seen[k].from) > 0.0F ? Eigen::Vector2f(-line.normal) : line.normal;
  }
}

/// Of what sonars heard, walls alone: a smooth one sends sound back to where its normal points, and what shows no such
/// line, as corners and what came back over two walls, may have been anywhere on its arc.
void keep_walls(std::vector<Seen>& seen) {
  Frame frame;
  for (auto const& point : seen) frame.points.push_back(point.at);
  find_normals(frame, seen);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    Eigen::Vector2f const back = (seen[k].from - seen[k].at).normalized();
    if (frame.has_normal(k) && frame.normals[k].dot(back) > static_cast<float>(std::cos(heard_aslant_rad)))
      seen[kept++] = seen[k];
  }
  seen.resize(kept);
}

Frame frame_of(std::vector<Seen>& seen) {
  std::ranges::sort(seen, {}, [](Seen const& s) { return std::tuple(s.bearing, s.at.x(), s.at.y()); });
  Frame frame;
  frame.goes_round = true;
  frame.bin_width = round / bins;
  frame.first_bearing = -0.5F * round;
  frame.free_of_bin.assign(bins, 0.0F);
  frame.first_of_bin.assign(bins + 1, 0);
  int filled = 0;
  for (auto const& point : seen) {
    auto const bin =
        std::clamp(static_cast<int>((point.bearing - frame.first_bearing) / frame.bin_width), filled, bins - 1);
    while (filled < bin) frame.first_of_bin[++filled] = static_cast<std::int32_t>(frame.points.size());
    auto const range = point.at.norm();
    frame.points.push_back(point.at);
    frame.ranges.push_back(range);
    // What lies behind was seen from elsewhere, so that only up to the nearest is it free.
    auto& free = frame.free_of_bin[static_cast<std::size_t>(bin)];
    free = free == 0.0F ? range : std::min(free, range);
  }
  while (filled < bins) frame.first_of_bin[++filled] = static_cast<std::int32_t>(frame.points.size());
  find_normals(frame, seen);
  return frame;
}

}  // namespace

void Gatherer::add(Scan const& scan, Sensor const& sensor, Pose2 const& odometry) {
  constexpr double step_m = 0.03;  // what stands still sees the same again and again
  constexpr double step_rad = 0.03;
  now_ = odometry;
  if (has_begun_ && distance_m(last_, odometry) < step_m && turn_rad(last_, odometry) < step_rad) return;
  if (has_begun_) {
    path_m_ += distance_m(last_, odometry);
    turn_rad_ += turn_rad(last_, odometry);
  }
  has_begun_ = true;
  last_ = odometry;
  hears_cones_ = sensor.half_cone_rad > 0.0F;
  auto const& bearings = bearings_of(scan, sensor);
  Turn const turn(odometry.yaw);
  Eigen::Vector2d const from = place(odometry) + turn * sensor.mount_m.cast<double>();
  for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
    auto const range = scan.ranges_m[b];
    if (!(range >= frame_options_.least_range_m && range < sensor.no_return_m && range <= frame_options_.most_range_m))
      continue;
    auto const bearing = double{bearings[b]};
    points_.push_back({from + turn * Eigen::Vector2d(range * std::cos(bearing), range * std::sin(bearing)), from});
  }
}

bool Gatherer::is_due() const {
  if (path_m_ >= options_.most_m || turn_rad_ >= options_.most_turn_rad) return true;
  return path_m_ >= options_.least_m && static_cast<int>(points_.size()) >= options_.enough_points;
}

Frame Gatherer::take() {
  Turn const turn(now_.yaw);
  std::vector<Seen> seen;
  for (auto const& point : points_) {
    Eigen::Vector2f const at = turn.back(point.at - place(now_)).cast<float>();
    seen.push_back({at, turn.back(point.from - place(now_)).cast<float>(), std::atan2(at.y(), at.x())});
  }
  points_.clear();
  path_m_ = 0.0;
  turn_rad_ = 0.0;
  if (hears_cones_) keep_walls(seen);
  return frame_of(seen);
}

}  // namespace lapwing::slam
