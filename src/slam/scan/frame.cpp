#include "slam/scan/frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/assert.hpp"
#include "slam/scan/line_through.hpp"

namespace lapwing::slam {
namespace {

/// The usual distance between neighbouring beams.
float step_of(std::vector<float> const& bearings) {
  if (bearings.size() < 2) return 0.1F;
  std::vector<float> steps;
  for (std::size_t i = 1; i < bearings.size(); ++i) steps.push_back(bearings[i] - bearings[i - 1]);
  std::ranges::nth_element(steps, steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2));
  return std::max(steps[steps.size() / 2], 1e-4F);
}

void lay_bins(Frame& frame, std::vector<float> const& bearings, float step) {
  constexpr auto round = 2.0F * std::numbers::pi_v<float>;
  auto const span = bearings.back() - bearings.front();
  frame.goes_round = span + 1.5F * step >= round;
  frame.bin_width = frame.goes_round ? round / std::round(round / step) : step;
  frame.first_bearing = bearings.front() - 0.5F * frame.bin_width;
  auto const count = frame.goes_round ? std::lround(round / frame.bin_width) : std::lround(span / step) + 1;
  frame.free_of_bin.assign(static_cast<std::size_t>(count), 0.0F);
}

}  // namespace

void find_normals(Frame& frame, float beam_step_rad) {
  constexpr int reach = 8;  // neighbours on either side
  auto const count = static_cast<int>(frame.points.size());
  frame.normals.assign(frame.points.size(), Eigen::Vector2f::Zero());
  std::array<Eigen::Vector2f, 2 * reach + 1> near;
  for (int k = 0; k < count; ++k) {
    // So far that at least three beams hit a wall that is seen at 45 degrees, and no farther than walls are straight.
    auto const radius = std::clamp(3.5F * beam_step_rad * frame.ranges[k], 0.12F, 0.5F);
    int found = 0;
    for (int j = k; j >= 0 && k - j < reach && (frame.points[j] - frame.points[k]).norm() <= radius; --j)
      near[found++] = frame.points[j];
    for (int j = k + 1; j < count && j - k < reach && (frame.points[j] - frame.points[k]).norm() <= radius; ++j)
      near[found++] = frame.points[j];
    if (found < 3) continue;
    auto const line = line_through(near.data(), found);
    if (!line.is_one) continue;
    frame.normals[k] =
        line.normal.dot(frame.points[k] - frame.centre) > 0.0F ? Eigen::Vector2f(-line.normal) : line.normal;
  }
}

Frame frame_of(Scan const& scan, Sensor const& sensor, FrameOptions const& options) {
  auto const& bearings = bearings_of(scan, sensor);
  LAPWING_ASSERT(scan.ranges_m.size() == bearings.size(), scan.ranges_m.size(), bearings.size());
  Frame frame;
  frame.centre = sensor.mount_m;
  if (bearings.empty()) return frame;
  auto const step = step_of(sensor.bearings_rad);
  lay_bins(frame, sensor.bearings_rad, step);
  auto const bins = frame.bins();
  frame.first_of_bin.assign(static_cast<std::size_t>(bins) + 1, 0);
  int filled = 0;
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    auto const range = scan.ranges_m[i];
    if (!(range >= options.least_range_m && range < sensor.no_return_m && range <= options.most_range_m)) continue;
    auto const bin =
        std::clamp(static_cast<int>((bearings[i] - frame.first_bearing) / frame.bin_width), filled, bins - 1);
    while (filled < bin) frame.first_of_bin[++filled] = static_cast<std::int32_t>(frame.points.size());
    frame.points.push_back(frame.centre + range * Eigen::Vector2f(std::cos(bearings[i]), std::sin(bearings[i])));
    frame.ranges.push_back(range);
    frame.free_of_bin[bin] = std::max(frame.free_of_bin[bin], range);
  }
  while (filled < bins) frame.first_of_bin[++filled] = static_cast<std::int32_t>(frame.points.size());
  find_normals(frame, step);
  return frame;
}

}  // namespace lapwing::slam
