#include "geo/site.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace lapwing::geo {

namespace {

bool is_place(Wgs84 place) {
  return std::abs(place.lat_rad) <= std::numbers::pi / 2.0 && std::abs(place.lon_rad) <= std::numbers::pi &&
         std::isfinite(place.alt_m);
}

/// Sorts the floors by height, and says what is wrong with them.
std::optional<base::Error> sort(std::vector<Floor>& floors) {
  using base::ErrorKind;
  for (auto const& floor : floors) {
    if (floor.id.empty())
      return base::Error{ErrorKind::invalid_input, "a floor has no id", "give each a short one: \"0\", \"1\", \"B1\""};
    bool const is_finite = std::isfinite(floor.up_m) && floor.site_from_floor.origin().is_finite() &&
                           std::isfinite(floor.site_from_floor.yaw_rad());
    if (!is_finite)
      return base::Error{ErrorKind::invalid_input, fmt::format("floor {}: a number is not finite", floor.id), ""};
    if (std::ranges::count(floors, floor.id, &Floor::id) > 1)
      return base::Error{ErrorKind::invalid_input, fmt::format("two floors are called {}", floor.id), ""};
  }
  std::ranges::sort(floors, {}, &Floor::up_m);
  auto const level = std::ranges::adjacent_find(floors, {}, &Floor::up_m);
  if (level != floors.end())
    return base::Error{
        ErrorKind::invalid_input,
        fmt::format("the floors {} and {} lie at one height, {:.2f} m", level->id, std::next(level)->id, level->up_m),
        "a floor that lies beside another at its height is a part of it"};
  return std::nullopt;
}

}  // namespace

base::Result<Site> Site::make(std::string id, Wgs84 anchor, std::vector<Floor> floors) {
  if (!is_place(anchor))
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("site {}: the anchor {:.5f}, {:.5f} is no place on Earth", id, anchor.lat_deg(), anchor.lon_deg()),
        "latitude is within 90 degrees and comes first, longitude within 180");
  if (floors.empty()) floors.push_back({.id = "0"});
  if (auto wrong = sort(floors)) {
    wrong->message = fmt::format("site {}: {}", id, wrong->message);
    return std::unexpected(*std::move(wrong));
  }
  return Site(std::move(id), anchor, std::move(floors));
}

Floor const* Site::floor(std::string_view id) const {
  auto const found = std::ranges::find(floors_, id, &Floor::id);
  return found == floors_.end() ? nullptr : &*found;
}

Floor const& Site::floor_at(double up_m, double tolerance_m) const {
  auto const above = std::ranges::upper_bound(floors_, up_m + tolerance_m, {}, &Floor::up_m);
  return above == floors_.begin() ? floors_.front() : *std::prev(above);
}

Point3<SiteFrame> Site::point_of(Wgs84 place) const {
  auto const enu = to_enu(frame_.ned_from(place));
  return {enu.east, enu.north, enu.up};
}

Wgs84 Site::place_of(Point3<SiteFrame> const& point) const {
  return frame_.place_at(to_ned({point.x(), point.y(), point.z()}));
}

Wgs84 Site::place_of(Point<FloorFrame> const& point, Floor const& floor) const {
  auto const level = floor.site_from_floor * point;
  return place_of(Point3<SiteFrame>(level.x(), level.y(), floor.up_m));
}

}  // namespace lapwing::geo
