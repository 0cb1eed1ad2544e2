#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "explore/strategy/open_tour.hpp"
#include "explore/strategy/strategy.hpp"

namespace lapwing::explore {

struct TourSettings {
  double look_every_s = 1.0;
  double gain_reach_m = 5.0;    ///< how far beyond a frontier unknown is counted
  double small_m2 = 0.3;        ///< less to see than this can wait,
  double small_detour_m = 1.5;  ///< unless it lies nearer to the way than this
  double depth_per_m = 1.5;     ///< metres that a frontier is thought to lead on, a square root of its unknown area
  double most_depth_m = 12.0;
  double keep_m = 1.0;          ///< another way must be so much shorter to leave the one that was taken
  double home_share = 0.0;      ///< of the way home that counts when a tour's end is chosen
  std::size_t most_sites = 36;  ///< the nearest; more would change nothing of what comes first
};

/// Ours: a route over all open frontiers, not only the nearest.
///
/// Frontiers that are looked at from the same place are one site. The cheapest tour over the sites is what the robot
/// follows, made anew when the map brings news. A frontier with much unknown beyond leads on, so that who goes through
/// it comes back late: the tour may end at one such, and saves the way back from its depth. So rooms and corners
/// are finished before the corridor goes on, if they are near, and left for the way back if they are not. What shows
/// next to nothing is left to the end unless it lies at the way.
///
/// Several robots: sites are given out one by one to whom they add least to the longest tour (sequential auction,
/// Lagoudakis et al. 2005).
class Tour : public Strategy {
 public:
  explicit Tour(TourSettings const& settings = {}) : settings_(settings) {}
  [[nodiscard]] std::vector<Order> decide(Situation const& situation) override;

 private:
  struct Site {
    std::vector<Frontier> frontiers;
    Cell stand = {};
    RoadMap::Node node = 0;
    double gain_m2 = 0.0;
    double depth_m = 0.0;
  };
  struct Target {
    Site site;
    Cell watched = {};  ///< the middle of what is looked for
  };

  [[nodiscard]] bool is_due(Situation const& situation);
  [[nodiscard]] std::vector<Site> sites(Situation const& situation, RoadMap::Tree const& reach) const;
  [[nodiscard]] double between(Situation const& situation, RoadMap::Tree const& reach, Site const& a, Site const& b);
  void fill_distances(Situation const& situation, std::vector<Site> const& sites);

  TourSettings settings_;
  double next_look_s_ = 0.0;
  std::vector<std::optional<Target>> targets_;  ///< a robot
  struct Known {
    float distance_m = 0.0F;
    double at_s = 0.0;
  };
  std::unordered_map<std::uint64_t, Known> distances_;  ///< between two nodes
};

}  // namespace lapwing::explore
