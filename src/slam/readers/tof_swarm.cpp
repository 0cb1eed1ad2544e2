#include "slam/readers/tof_swarm.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <numeric>

#include "slam/readers/log_builder.hpp"
#include "slam/readers/text_lines.hpp"

namespace lapwing::slam {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::size_t columns = 8;  ///< of one camera
constexpr std::array axes{0.0, 180.0, 90.0, -90.0};
constexpr std::array offsets_m{0.02, 0.02, 0.025, 0.025};  ///< of the cameras from the drone's middle, along their axes
constexpr std::size_t beams = columns * axes.size();
constexpr std::size_t first_depth = tof_swarm_columns - beams;
constexpr float no_return_m = 4.0F;
constexpr double most_drones = 1000.0;

struct Beam {
  double bearing;
  double off_axis;
  double offset_m;
  std::size_t column;
};

/// In the order of their bearings.
std::vector<Beam> all_beams() {
  constexpr double middle = 0.5 * (columns - 1);
  constexpr double wide = 45.0 / columns;
  std::vector<Beam> all;
  for (std::size_t c = 0; c < axes.size(); ++c)
    for (std::size_t k = 0; k < columns; ++k) {
      auto const off = (middle - static_cast<double>(k)) * wide * degree;
      all.push_back({geo::wrap_pi(axes[c] * degree + off), off, offsets_m[c], first_depth + c * columns + k});
    }
  std::ranges::sort(all, {}, &Beam::bearing);
  return all;
}

Pose2 odometry_of(std::array<double, tof_swarm_columns> const& v) {
  // The frame's offset lies along the axes of the world.
  return {v[3] + v[12], v[4] + v[13], geo::wrap_pi(v[5] + v[14])};
}

std::vector<float> ranges_of(std::array<double, tof_swarm_columns> const& v, std::vector<Beam> const& all) {
  std::vector<float> ranges;
  for (auto const& beam : all) {
    // A camera tells depths along its axis.
    auto const depth = v[beam.column];
    auto const range = depth / std::cos(beam.off_axis) + beam.offset_m * std::cos(beam.off_axis);
    ranges.push_back(depth > 0.0 ? static_cast<float>(range) : no_return_m);
  }
  return ranges;
}

}  // namespace

base::Result<ScanLog> read_tof_swarm(std::string_view text) {
  constexpr double scans_per_s = 10.0;
  auto const all = all_beams();
  Sensor sensor{.bearings_rad = {}, .no_return_m = no_return_m};
  for (auto const& beam : all) sensor.bearings_rad.push_back(static_cast<float>(beam.bearing));
  std::map<int, std::vector<Scan>> of_drone;
  Lines lines(text);
  std::size_t readings = 0;
  while (auto const line = lines.next()) {
    if (line->empty() || line->starts_with('#')) continue;
    Words words(*line, ',');
    std::array<double, tof_swarm_columns> values{};
    auto is_whole = true;
    for (std::size_t i = 0; i < values.size(); ++i) {
      auto const number = words.number();  // the true pose may be missing: nan
      auto const may_be_missing = i >= 9 && i < 12;
      is_whole = is_whole && number && (std::isfinite(*number) || may_be_missing);
      values[i] = number.value_or(0.0);
    }
    if (!is_whole && !lines.is_whole()) continue;
    if (!is_whole) return fail_at(lines.number(), fmt::format("expected {} numbers", tof_swarm_columns));
    if (values[0] < 0.0 || values[0] >= most_drones || values[0] != std::floor(values[0]))
      return fail_at(lines.number(), fmt::format("a drone's number must be 0 to {}", most_drones - 1.0));
    readings += beams;
    if (readings > LogBuilder::most_readings)
      return fail_at(lines.number(), fmt::format("more than {} readings", LogBuilder::most_readings),
                     "cut the log into parts");
    auto& scans = of_drone[static_cast<int>(values[0])];
    scans.push_back({.time = LogTime(static_cast<double>(scans.size()) / scans_per_s),
                     .sensor = 0,
                     .odometry = odometry_of(values),
                     .ranges_m = ranges_of(values, all)});
  }
  if (of_drone.empty()) return base::fail(base::ErrorKind::invalid_input, "no scan");
  auto& most = std::ranges::max_element(of_drone, {}, [](auto const& drone) { return drone.second.size(); })->second;
  LogBuilder builder;
  auto const number = builder.sensor(sensor);
  for (auto& scan : most) {
    scan.sensor = *number;
    if (!builder.add(std::move(scan))) break;
  }
  return std::move(builder).finish();
}

}  // namespace lapwing::slam
