#include "robot/mapping/pose_check.hpp"

#include <cmath>
#include <cstdint>

namespace lapwing::robot {

namespace {

constexpr std::size_t every = 3;  // neighbouring beams say the same
constexpr int enough_ends = 30;
constexpr double near_m = 0.3;  ///< what loops have not moved on the map yet is nearer than that
constexpr double free_below = 0.25;
constexpr double taken_above = 0.5;

constexpr double lost_above = 0.6;
constexpr double found_below = 0.3;
constexpr double lost_after_s = 2.0;
constexpr double found_after_s = 1.0;

bool is_taken_near(map::OccupancyGrid const& grid, map::Cell middle) {
  auto const reach = static_cast<std::int32_t>(std::ceil(near_m / grid.resolution_m()));
  for (auto y = middle.y - reach; y <= middle.y + reach; ++y)
    for (auto x = middle.x - reach; x <= middle.x + reach; ++x)
      if (auto const cell = grid.at({x, y}); cell.is_seen() && cell.probability() > taken_above) return true;
  return false;
}

}  // namespace

std::optional<double> misfit(map::OccupancyGrid const& grid, std::span<geo::Point<map::GridFrame> const> ends) {
  int known = 0;
  int on_free_floor = 0;
  for (std::size_t i = 0; i < ends.size(); i += every) {
    auto const cell = grid.cell_at(ends[i]);
    auto const evidence = grid.at(cell);
    if (!evidence.is_seen()) continue;
    ++known;
    if (evidence.probability() < free_below && !is_taken_near(grid, cell)) ++on_free_floor;
  }
  if (known < enough_ends) return std::nullopt;
  return static_cast<double>(on_free_floor) / known;
}

bool PoseCheck::feed(double time_s, std::optional<double> misfit) {
  bool const says_otherwise = misfit && (is_lost_ ? *misfit < found_below : *misfit > lost_above);
  if (!says_otherwise) {
    otherwise_since_s_.reset();
    return is_lost_;
  }
  if (!otherwise_since_s_) otherwise_since_s_ = time_s;
  if (time_s - *otherwise_since_s_ < (is_lost_ ? found_after_s : lost_after_s)) return is_lost_;
  is_lost_ = !is_lost_;
  otherwise_since_s_.reset();
  return is_lost_;
}

}  // namespace lapwing::robot
