#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "explore/strategy/strategy.hpp"

namespace lapwing::explore {

struct SiteSettings {
  double gain_reach_m = 5.0;  ///< how far beyond a frontier unknown is counted
  double view_m = 4.0;        ///< frontiers are looked at from no farther than this
  double same_m = 1.0;        ///< places to look from that are nearer to each other are one
  double depth_per_m = 1.5;   ///< metres that a frontier is thought to lead on, a square root of its unknown area
  double most_depth_m = 12.0;
  std::size_t most_sites = 36;  ///< the nearest; more would change nothing of what comes first
};

/// A place to look from, and what is to be seen there.
struct Site {
  std::vector<Frontier> frontiers;
  Cell place = {};
  RoadMap::Node node = 0;
  double gain_m2 = 0.0;  ///< unknown that may be seen
  double depth_m = 0.0;  ///< how far it is thought to lead on
};

/// Groups the open frontiers by where they can be looked at from: on the way to where one would stand before a
/// frontier, the first place from which a straight line goes over it into the unknown.
class Sites {
 public:
  Sites(SiteSettings const& settings) : settings_(settings) {}

  /// The nearest first.
  [[nodiscard]] std::vector<Site> find(Situation const& situation, RoadMap::Tree const& reach);
  /// It was looked at from the site's place and remained: next time from nearby, and after that not again.
  void has_remained(Situation const& situation, Site const& site);

  /// Metres between the places of two sites that were found last. `reach`: as they were found with.
  [[nodiscard]] double between_m(Situation const& situation, RoadMap::Tree const& reach, Site const& a,
                                 Site const& b) const;

 private:
  void look_up_distances(Situation const& situation, std::vector<Site> const& sites);
  [[nodiscard]] RoadMap::Node view_of(Situation const& situation, RoadMap::Tree const& reach,
                                      Frontier const& frontier) const;

  struct Known {
    float distance_m = 0.0F;
    double at_s = 0.0;
  };
  SiteSettings settings_;
  DenseGrid<std::uint8_t> is_near_only_;                ///< frontier cells that were not seen through from afar
  std::unordered_map<std::uint64_t, Known> distances_;  ///< between two nodes
};

}  // namespace lapwing::explore
