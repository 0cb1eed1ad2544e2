#include "host/robots/robots_feed.hpp"

#include <nlohmann/json.hpp>

#include "geo/position_json.hpp"

namespace lapwing::host {

using geo::Json;

namespace {

/// Longitude and latitude, as GeoJSON has them; 1e-8 degrees are a millimetre.
Json place_json(geo::Site const& site, geo::Point<geo::SiteFrame> const& point) {
  auto const place = site.place_of(geo::Point3<geo::SiteFrame>(point.x(), point.y(), 0.0));
  return Json::array({geo::rounded(place.lon_deg(), 8), geo::rounded(place.lat_deg(), 8)});
}

Json robot_json(robot::Robot const& robot, geo::Site const& site) {
  Json json{{"id", robot.spec().id}, {"way", Json::array()}, {"frontiers", Json::array()}};
  for (auto const& point : robot.way()) json["way"].push_back(place_json(site, point));
  if (auto const& survey = robot.survey()) {
    json["coverage"] = geo::rounded(survey->coverage, 3);
    json["free_m2"] = geo::rounded(survey->free_m2, 1);
    for (auto const& place : survey->frontiers) json["frontiers"].push_back(place_json(site, robot.on_site(place)));
  }
  if (auto const spread = robot.spread())
    json["spread"] = {{"major_m", geo::rounded(spread->major_m, 2)},
                      {"minor_m", geo::rounded(spread->minor_m, 2)},
                      {"axis_rad", geo::rounded(spread->axis_rad, 1)}};
  return json;
}

}  // namespace

std::string RobotsFeed::text() const {
  Json json{{"type", "robots"}, {"robots", Json::array()}};
  for (auto const& robot : robots_.robots())
    if (auto const* const site = map_.site(robot->spec().site)) json["robots"].push_back(robot_json(*robot, *site));
  return json.dump();
}

}  // namespace lapwing::host
