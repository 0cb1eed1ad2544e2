#include "station/map/site_json.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "map/features/text_fault.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

Json floor_json(geo::Floor const& floor) {
  auto const& plan = floor.site_from_floor;
  return {{"id", floor.id},
          {"name", floor.name},
          {"up_m", rounded(floor.up_m, 3)},
          {"x_m", rounded(plan.origin().x(), 4)},
          {"y_m", rounded(plan.origin().y(), 4)},
          {"yaw_rad", rounded(plan.yaw_rad(), 8)}};
}

Json site_json(geo::Site const& site) {
  Json floors = Json::array();
  for (auto const& floor : site.floors()) floors.push_back(floor_json(floor));
  auto const anchor = site.anchor();
  // A millimetre: what is measured within the site counts from here.
  return {{"id", site.id()},
          {"anchor",
           {{"lat_deg", rounded(anchor.lat_deg(), 9)},
            {"lon_deg", rounded(anchor.lon_deg(), 9)},
            {"alt_m", rounded(anchor.alt_m, 3)}}},
          {"floors", std::move(floors)}};
}

std::unexpected<base::Error> wrong(std::string message) {
  return base::fail(base::ErrorKind::invalid_input, std::move(message), "See docs/reference/openapi.yaml.");
}

/// Sorted by key: in one that keeps its order, a member is found by looking at all before it.
using Given = nlohmann::json;

/// Nested no deeper than a site is.
base::Result<Given> parse_object(std::string_view text) {
  constexpr int deepest = 8;
  bool is_too_deep = false;
  auto const look = [&](int depth, Given::parse_event_t, Given&) {
    is_too_deep = is_too_deep || depth > deepest;
    return !is_too_deep;
  };
  auto json = Given::parse(text.begin(), text.end(), look, false);
  if (is_too_deep || json.is_discarded() || !json.is_object()) return wrong("this is no JSON object");
  return json;
}

/// A member that is text, or the fallback when it is absent.
base::Result<std::string> text_member(Given const& object, char const* key, std::string fallback) {
  auto const member = object.find(key);
  if (member == object.end()) return fallback;
  if (!member->is_string()) return wrong(fmt::format("\"{}\" must be text", key));
  return member->get<std::string>();
}

/// A member that is a finite number, or nothing when it is absent.
base::Result<std::optional<double>> number_member(Given const& object, char const* key) {
  auto const member = object.find(key);
  if (member == object.end()) return std::optional<double>();
  if (!member->is_number() || !std::isfinite(member->get<double>()))
    return wrong(fmt::format("\"{}\" must be a number", key));
  return std::optional(member->get<double>());
}

/// A number that may be missing.
base::Result<double> number_or(Given const& object, char const* key, double otherwise) {
  auto const number = number_member(object, key);
  if (!number) return std::unexpected(number.error());
  return number->value_or(otherwise);
}

base::Result<geo::Wgs84> parse_anchor(Given const& object) {
  auto const anchor = object.find("anchor");
  if (anchor == object.end() || !anchor->is_object())
    return wrong("\"anchor\", {\"lat_deg\", \"lon_deg\", \"alt_m\"?}, is missing");
  auto const lat_deg = number_member(*anchor, "lat_deg");
  auto const lon_deg = number_member(*anchor, "lon_deg");
  auto const alt_m = number_or(*anchor, "alt_m", 0.0);
  if (!lat_deg || !lon_deg || !alt_m) return wrong("a number of \"anchor\" is none");
  if (!*lat_deg || !*lon_deg) return wrong("\"anchor\" needs \"lat_deg\" and \"lon_deg\"");
  return geo::Wgs84::from_degrees(**lat_deg, **lon_deg, *alt_m);
}

base::Result<geo::Floor> parse_floor(Given const& object, std::size_t index) {
  auto const place = fmt::format("/floors/{}", index);
  if (!object.is_object()) return wrong(place + " is no object");
  auto id = text_member(object, "id", "");
  auto name = text_member(object, "name", "");
  if (!id || !name) return wrong(fmt::format("{}: {}", place, (id ? name : id).error().message));
  if (auto const fault = map::id_fault(*id)) return wrong(fmt::format("{}/id {}", place, *fault));
  if (auto const fault = map::text_fault(*name, map::most_name_bytes))
    return wrong(fmt::format("{}/name {}", place, *fault));
  auto const up_m = number_or(object, "up_m", 0.0);
  auto const x_m = number_or(object, "x_m", 0.0);
  auto const y_m = number_or(object, "y_m", 0.0);
  auto const yaw_rad = number_or(object, "yaw_rad", 0.0);
  for (auto const* const number : {&up_m, &x_m, &y_m, &yaw_rad})
    if (!*number) return wrong(fmt::format("{}: {}", place, number->error().message));
  return geo::Floor{
      .id = *std::move(id), .name = *std::move(name), .up_m = *up_m, .site_from_floor = {{*x_m, *y_m}, *yaw_rad}};
}

}  // namespace

std::string sites_message(map::LiveMap const& map) {
  Json sites = Json::array();
  for (auto const& [id, site] : map.sites()) sites.push_back(site_json(site));
  return dump({{"type", "sites"}, {"sites", std::move(sites)}});
}

std::string site_body(geo::Site const& site) {
  return dump(site_json(site));
}

base::Result<geo::Site> parse_site(std::string const& id, std::string_view body) {
  if (auto const fault = map::id_fault(id)) return wrong(fmt::format("the id of a site {}", *fault));
  auto const object = parse_object(body);
  if (!object) return std::unexpected(object.error());
  auto const anchor = parse_anchor(*object);
  if (!anchor) return std::unexpected(anchor.error());
  std::vector<geo::Floor> floors;
  if (auto const list = object->find("floors"); list != object->end()) {
    if (!list->is_array() || list->size() > most_floors)
      return wrong(fmt::format("\"floors\" must be a list of at most {}", most_floors));
    for (auto const& one : *list) {
      auto floor = parse_floor(one, floors.size());
      if (!floor) return std::unexpected(floor.error());
      floors.push_back(*std::move(floor));
    }
  }
  return geo::Site::make(id, *anchor, std::move(floors));
}

}  // namespace lapwing::station
