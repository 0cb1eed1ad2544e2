#pragma once

#include <optional>
#include <string>
#include <variant>

#include "geo/position.hpp"
#include "geo/site.hpp"

namespace lapwing::vehicle {

/// Where something is on the globe, and where it looks.
struct GlobePose {
  geo::Wgs84 position;
  std::optional<double> heading_rad = {};  ///< clockwise from true north

  friend bool operator==(GlobePose const&, GlobePose const&) = default;
};

/// Where something is in the frame of a site, and where it looks: indoors there is no better position.
struct SitePose {
  std::string site;        ///< its id
  std::string floor = {};  ///< its id; empty where the site's ground is meant
  geo::Point3<geo::SiteFrame> position;
  double yaw_rad = 0.0;  ///< counterclockwise from the frame's x axis, which points east

  friend bool operator==(SitePose const&, SitePose const&) = default;
};

/// A pose that names its frame.
using Place = std::variant<GlobePose, SitePose>;

/// On the globe, by the site's anchor. Nothing for a pose in the frame of another site.
[[nodiscard]] std::optional<GlobePose> on_globe(Place const& place, geo::Site const& site);

}  // namespace lapwing::vehicle
