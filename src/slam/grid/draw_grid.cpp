#include "slam/grid/draw_grid.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

namespace lapwing::slam {
namespace {

constexpr float steps_per_log_odds = 256.0F;

/// A rectangle of cells, each with what beams have said of it so far.
struct Sheet {
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double cell_m = 0.05;
  int width = 0;
  int height = 0;
  std::vector<float> log_odds = {};
  std::vector<bool> seen = {};

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  void add(int x, int y, float evidence) {
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    auto const at = index(x, y);
    // What was said a hundred times is not surer than what was said thirty times, and a door may open.
    constexpr float most = 12.0F;
    log_odds[at] = std::clamp(log_odds[at] + evidence, -most, most);
    seen[at] = true;
  }
};

bool is_hit(float range, Sensor const& sensor, BeamModel const& model) {
  return range > 0.05F && range < sensor.no_return_m && range <= static_cast<float>(model.most_range_m);
}

Sheet sheet_for(ScanLog const& log, std::vector<Pose2> const& poses, BeamModel const& model) {
  Eigen::Vector2d low = place(poses.front());
  Eigen::Vector2d high = low;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto const& sensor = log.sensors[log.scans[i].sensor];
    float longest = 1.0F;
    for (auto const range : log.scans[i].ranges_m)
      if (is_hit(range, sensor, model)) longest = std::max(longest, range);
    auto const reach = Eigen::Vector2d::Constant(longest + sensor.mount_m.norm());
    low = low.cwiseMin(place(poses[i]) - reach);
    high = high.cwiseMax(place(poses[i]) + reach);
  }
  constexpr double most_cells = 1e8;
  Sheet sheet{.origin = low, .cell_m = model.cell_m};
  auto const size = [&] { return ((high - low) / sheet.cell_m).array().ceil() + 1.0; };
  while (size().prod() > most_cells) sheet.cell_m *= 2.0;
  sheet.origin = (low / sheet.cell_m).array().floor() * sheet.cell_m;
  sheet.width = static_cast<int>(size().x()) + 1;
  sheet.height = static_cast<int>(size().y()) + 1;
  auto const cells = static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height);
  sheet.log_odds.assign(cells, 0.0F);
  sheet.seen.assign(cells, false);
  return sheet;
}

/// One beam: free up to where its end may begin, then taken as likely as the end lies in each cell.
void draw_beam(Sheet& sheet, Eigen::Vector2d const& from, Eigen::Vector2d const& direction, double range,
               BeamModel const& model) {
  auto const noise = model.noise_m + model.noise_per_m * range;
  auto const free_until = range - std::max(2.0 * noise, sheet.cell_m);
  Eigen::Vector2d const begin = (from - sheet.origin) / sheet.cell_m;
  auto const step = 0.7;  // cells: none on the way is left out by more than a corner
  int last_x = -1;
  int last_y = -1;
  for (double way = 0.0; way * sheet.cell_m < free_until; way += step) {
    Eigen::Vector2d const at = begin + way * direction;
    auto const x = static_cast<int>(at.x());
    auto const y = static_cast<int>(at.y());
    if (x == last_x && y == last_y) continue;
    last_x = x;
    last_y = y;
    auto const width = way * sheet.cell_m * model.width_rad;
    sheet.add(x, y, static_cast<float>(model.free_log_odds * std::min(1.0, sheet.cell_m / std::max(width, 1e-6))));
  }
  auto const reach = static_cast<int>(std::ceil(2.0 * noise / sheet.cell_m));
  double sum = 0.0;
  for (int c = -reach; c <= reach; ++c) sum += std::exp(-0.5 * std::pow(c * sheet.cell_m / noise, 2));
  for (int c = -reach; c <= reach; ++c) {
    Eigen::Vector2d const at = begin + (range / sheet.cell_m + c) * direction;
    auto const share = std::exp(-0.5 * std::pow(c * sheet.cell_m / noise, 2)) / sum;
    if (share > 0.05)
      sheet.add(static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<float>(share * model.taken_log_odds));
  }
}

map::OccupancyGrid as_grid(Sheet const& sheet) {
  map::OccupancyGrid grid(sheet.cell_m);
  auto const left = static_cast<int>(std::lround(sheet.origin.x() / sheet.cell_m));
  auto const bottom = static_cast<int>(std::lround(sheet.origin.y() / sheet.cell_m));
  map::GridTile* tile = nullptr;
  map::TileKey key;
  for (int y = 0; y < sheet.height; ++y) {
    tile = nullptr;
    for (int x = 0; x < sheet.width; ++x) {
      if (!sheet.seen[sheet.index(x, y)]) continue;
      map::Cell const cell{left + x, bottom + y};
      if (auto const of_cell = map::tile_of(cell); tile == nullptr || of_cell != key) {
        key = of_cell;
        tile = &grid.tile_to_write(key);
      }
      auto const within =
          static_cast<std::size_t>(cell.y & 255) * map::tile_cells + static_cast<std::size_t>(cell.x & 255);
      tile->cells[within] = map::Evidence::of_steps(
          static_cast<int>(std::lround(sheet.log_odds[sheet.index(x, y)] * steps_per_log_odds)));
    }
  }
  return grid;
}

}  // namespace

map::OccupancyGrid draw_grid(ScanLog const& log, std::vector<Pose2> const& poses, BeamModel const& model) {
  LAPWING_ASSERT(poses.size() == log.scans.size(), poses.size(), log.scans.size());
  if (poses.empty()) return map::OccupancyGrid(model.cell_m);
  auto sheet = sheet_for(log, poses, model);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto const& scan = log.scans[i];
    auto const& sensor = log.sensors[scan.sensor];
    auto const& bearings = bearings_of(scan, sensor);
    Turn const turn(poses[i].yaw);
    Eigen::Vector2d const from = place(poses[i]) + turn * sensor.mount_m.cast<double>();
    for (std::size_t b = 0; b < scan.ranges_m.size(); ++b) {
      if (!is_hit(scan.ranges_m[b], sensor, model)) continue;
      auto const bearing = poses[i].yaw + double{bearings[b]};
      draw_beam(sheet, from, {std::cos(bearing), std::sin(bearing)}, scan.ranges_m[b], model);
    }
  }
  return as_grid(sheet);
}

}  // namespace lapwing::slam
