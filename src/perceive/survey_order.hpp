#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "explore/lot/survey_planner.hpp"
#include "geo/position.hpp"
#include "geo/site.hpp"

namespace lapwing::perceive {

/// Above home, metres: those that the operator has configured.
struct HoverHeights {
  double lowest_m = 7.0;
  double desired_m = 10.0;
  double highest_m = 20.0;
  friend bool operator==(HoverHeights const&, HoverHeights const&) = default;
};

/// What is to be surveyed, and how.
struct SurveyOrder {
  std::string name = "lot";              ///< of the site, in what is written
  std::vector<geo::Wgs84> area = {};     ///< corners in order round it; altitudes do not count
  std::vector<geo::Wgs84> fence = {};    ///< beyond which nothing flies; empty: area, home and some metres round them
  double ground_m = 0.0;                 ///< of the car park, above home
  explore::SurveySettings planner = {};  ///< but for its ground and heights
  double camera_yaw_rad = 0.0;           ///< of the camera on the drone
  explore::LotSettings lot = {};
  double enough_coverage =
      2.0;  ///< the survey ends when so much is covered; above 1: when nothing more is to be learned
  double most_s = std::numeric_limits<double>::infinity();
  base::Duration lot_lost = std::chrono::seconds(30);  ///< over the area without a slot: vision has lost the lot
};

/// Where the order is carried out: the local frame of the bus on the globe, and home in it.
struct SurveyGround {
  geo::Wgs84 anchor;  ///< the frame's origin
  geo::Point3<geo::SiteFrame> home = {};
};

/// By a frame's home on the globe and in the frame itself.
[[nodiscard]] geo::Wgs84 anchor_of(geo::Wgs84 home, geo::Point3<geo::SiteFrame> const& in_frame);

/// Corners on the globe as an outline in the site's frame.
[[nodiscard]] geo::Polygon<geo::SiteFrame> outline_of(std::vector<geo::Wgs84> const& corners, geo::Site const& site);

/// A fence for who has named none: convex, `margin_m` round all of the places.
[[nodiscard]] geo::Polygon<geo::SiteFrame> fence_round(std::vector<map::SitePoint> const& places, double margin_m);

}  // namespace lapwing::perceive
