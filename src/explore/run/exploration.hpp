#pragma once

#include <memory>
#include <vector>

#include "base/error.hpp"
#include "explore/known/known_map.hpp"
#include "explore/lead/explorer.hpp"
#include "explore/run/report.hpp"
#include "explore/run/settings.hpp"
#include "explore/simulated/carrier.hpp"
#include "explore/simulated/laser.hpp"
#include "explore/simulated/walkers.hpp"
#include "explore/simulated/world.hpp"
#include "explore/strategy/known_floor.hpp"

namespace lapwing::explore {

/// One run: robots explore a simulated floor with a strategy, share what they see, and return. Poses are known, as a
/// mapping unit would tell them. The same world, settings and starts give the same run.
class Exploration {
 public:
  /// Errors, invalid_input: no strategy of that name; a start without room; more or fewer starts than robots.
  [[nodiscard]] static base::Result<Exploration> begin(std::shared_ptr<World const> world, Settings const& settings,
                                                       std::vector<Pose> starts);

  /// A tenth of a second. False when it is over.
  [[nodiscard]] bool step();
  [[nodiscard]] RunReport report() const;
  [[nodiscard]] double coverage() const;
  [[nodiscard]] double time_s() const { return static_cast<double>(steps_) * step_s; }
  [[nodiscard]] double travel_m() const;

  [[nodiscard]] World const& world() const { return *world_; }
  [[nodiscard]] KnownMap const& map() const { return *map_; }
  /// Where a robot has been, every half second at most, as far as it moved.
  [[nodiscard]] std::vector<Place> const& track(std::size_t robot) const { return robots_[robot].track; }

  static constexpr double step_s = 0.1;
  /// The name of the one strategy that is told the floor: a yardstick for the others.
  static constexpr std::string_view known_floor = "known-floor";

 private:
  struct Robot {
    Carrier carrier;
    Pose start;
    Place scanned_at = {};  ///< where it last looked around
    bool has_scanned = false;
    std::vector<Place> track = {};
  };

  Exploration(std::shared_ptr<World const> world, Settings const& settings, std::vector<Pose> const& starts);

  [[nodiscard]] TrueFloor true_floor() const;
  void look();
  void count_seen();
  void lead();
  void drive();
  void walk();
  void check_collisions();
  [[nodiscard]] SideDistances sides_of(std::size_t robot) const;
  [[nodiscard]] std::vector<Disc> robots_but(std::size_t robot, double more_m) const;
  /// People, too.
  [[nodiscard]] std::vector<Disc> others_than(std::size_t robot, double more_m) const;
  [[nodiscard]] bool is_over() const;

  std::shared_ptr<World const> world_;
  Settings settings_;
  Random random_;
  std::unique_ptr<KnownMap> map_;
  std::unique_ptr<Explorer> explorer_;
  std::vector<Robot> robots_;
  Walkers walkers_;
  DenseGrid<std::uint8_t> is_counted_;
  std::size_t counted_ = 0;
  std::int64_t steps_ = 0;
  int collisions_ = 0;
  std::optional<double> travel_to_99_m_;
  std::optional<double> time_to_99_s_;
};

}  // namespace lapwing::explore
