#pragma once

#include <span>
#include <vector>

#include "explore/simulated/laser.hpp"
#include "explore/simulated/world.hpp"

namespace lapwing::explore {

/// People who walk about the floor, straight from one place they can see to the next, and stop before robots.
class Walkers {
 public:
  Walkers(World const& world, int people, std::span<Pose const> robots, Random& random);

  void step(World const& world, double seconds, std::span<Disc const> robots, Random& random);
  [[nodiscard]] std::vector<Disc> discs() const;

  static constexpr double radius_m = 0.25;

 private:
  struct Walker {
    Place at;
    Place to;
    double speed_m_s = 0.0;
    double waits_s = 0.0;
  };
  void choose(World const& world, Walker& walker, Random& random) const;

  std::vector<Walker> walkers_;
};

}  // namespace lapwing::explore
