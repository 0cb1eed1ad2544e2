#pragma once

#include <vector>

#include "base/error.hpp"
#include "explore/floor/dense_grid.hpp"
#include "geo/polygon.hpp"
#include "geo/site.hpp"
#include "map/features/geometry.hpp"

namespace lapwing::explore {

/// Ways that stay within a fence and out of its holes: straight where that is so, else round its corners (a visibility
/// graph; Lozano-Pérez & Wesley 1979).
class FenceRoutes {
 public:
  /// Errors, invalid_input: no sound polygon; more corners than it takes; no room left within the margin.
  [[nodiscard]] static base::Result<FenceRoutes> make(geo::Polygon<geo::SiteFrame> fence, double margin_m);

  /// In it, and at least the margin from its edges.
  [[nodiscard]] bool contains(map::SitePoint const& place) const;
  /// Places to fly straight to one after the other, the last of which is `to`; empty where there is no way. From beyond
  /// the margin, but within the fence, the way leads back in.
  [[nodiscard]] std::vector<map::SitePoint> route(map::SitePoint const& from, map::SitePoint const& to) const;
  [[nodiscard]] geo::Polygon<geo::SiteFrame> const& fence() const { return fence_; }

  static constexpr std::size_t most_corners = 64;

 private:
  FenceRoutes(geo::Polygon<geo::SiteFrame> fence, double margin_m);
  /// The straight way keeps `margin_m` from every edge.
  [[nodiscard]] bool is_clear(map::SitePoint const& from, map::SitePoint const& to, double margin_m) const;
  void find_bends();

  geo::Polygon<geo::SiteFrame> fence_;
  double margin_m_;
  std::vector<map::SitePoint> bends_;           ///< places beside corners
  std::vector<std::vector<double>> between_m_;  ///< of bends, by the shortest way
  std::vector<std::vector<std::size_t>> next_;  ///< on that way; from and to by their numbers
};

/// Metres; infinite for an empty route.
[[nodiscard]] double route_length_m(map::SitePoint const& from, std::vector<map::SitePoint> const& route);

}  // namespace lapwing::explore
