#include "explore/run/starts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <random>

namespace lapwing::explore {

base::Result<Pose> random_start(FloorPlan const& plan, std::vector<Place> const& possible, std::uint64_t seed) {
  if (possible.empty())
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("nowhere on the floor plan has a robot room (cells of {} m)", plan.cell_m),
                      "is its `resolution` right? doors must be wider than the robot and twice its safe distance");
  std::mt19937_64 random(seed * 0x9E3779B97F4A7C15ULL + 1);
  auto const which = random() % possible.size();
  double const yaw = (static_cast<double>(random() % 3600) / 1800.0 - 1.0) * std::numbers::pi;
  return Pose{possible[which], yaw};
}

base::Result<std::vector<Pose>> starts_around(World const& world, Pose const& first, Settings const& settings) {
  std::vector<Pose> starts = {first};
  // So that one that stands at its start leaves a way between itself and the next.
  double const apart_m = 4.0 * (settings.carrier.radius_m + settings.carrier.safe_distance_m) + 0.3;
  double const cell_m = world.cell_m();
  DenseGrid<std::uint8_t> reached(world.width(), world.height(), 0);
  std::vector<Cell> open = {cell_under(first.position, cell_m)};
  reached[open.front()] = 1;
  // In rings of steps: over standable cells, but the first may be where the robot has just room.
  for (std::size_t i = 0; i < open.size() && starts.size() < static_cast<std::size_t>(settings.robots); ++i) {
    auto const place = middle_of(open[i], cell_m);
    bool const is_apart =
        std::ranges::all_of(starts, [&](Pose const& other) { return distance_m(other.position, place) >= apart_m; });
    if (is_apart && world.is_standable()[open[i]] != 0) starts.push_back({place, first.yaw_rad});
    for (auto const away : neighbours) {
      auto const next = open[i] + away;
      if (!reached.contains(next) || reached[next] != 0) continue;
      bool const is_near_first = distance_m(middle_of(next, cell_m), first.position) < 0.5;
      if (world.is_standable()[next] == 0 && !(is_near_first && world.is_free_at(next))) continue;
      reached[next] = 1;
      open.push_back(next);
    }
  }
  if (starts.size() < static_cast<std::size_t>(settings.robots))
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("there is room for {} robots where they start, not for {}", starts.size(), settings.robots),
        "give fewer --robots or another --start");
  return starts;
}

}  // namespace lapwing::explore
