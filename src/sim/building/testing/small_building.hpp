#pragma once

#include <memory>

#include "sim/building/building.hpp"

namespace lapwing::sim::building::testing {

/// A room of 8 by 5 metres with a closed door in its northern wall, whose front is inside.
[[nodiscard]] inline BuildingPlan small_plan() {
  BuildingPlan plan;
  Place const corners[] = {{0, 0}, {8, 0}, {8, 5}, {0, 5}};
  for (int i = 0; i < 4; ++i)
    plan.walls.push_back({.from = corners[i], .to = corners[(i + 1) % 4], .thickness_m = 0.1});
  DoorPlan door{.id = "221", .hinge = {3, 5}, .latch = {4, 5}, .opens_to = Side::left};
  door.sign = "221";
  plan.doors = {door};
  return plan;
}

[[nodiscard]] inline std::unique_ptr<Building> small_building(Pose const& start, std::uint64_t seed = 1,
                                                              BuildingPlan plan = small_plan()) {
  BuildingOptions options{.seed = seed, .robots = 1, .starts = {start}};
  return Building::make(std::move(plan), std::move(options)).value();
}

}  // namespace lapwing::sim::building::testing
