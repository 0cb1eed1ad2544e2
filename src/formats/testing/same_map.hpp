#pragma once

#include <cmath>
#include <map>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "formats/map_contents.hpp"
#include "map/features/properties.hpp"

namespace lapwing::formats::testing {

/// To a tenth of a millimetre, by points in their order from the first corner on.
inline bool are_same(map::SitePoint const& a, map::SitePoint const& b) {
  return geo::distance_m(a, b) < 1e-4;
}
inline bool are_same(std::vector<map::SitePoint> const& a, std::vector<map::SitePoint> const& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!are_same(a[i], b[i])) return false;
  }
  return true;
}
inline bool are_same(map::LineString const& a, map::LineString const& b) {
  return are_same(a.points, b.points);
}
/// Rings may go the other way round, and begin elsewhere: both areas and their common corners count.
inline bool are_same(map::SitePolygon const& a, map::SitePolygon const& b) {
  if (a.rings.size() != b.rings.size() || std::abs(geo::area_m2(a) - geo::area_m2(b)) > 1e-2) return false;
  for (std::size_t ring = 0; ring < a.rings.size(); ++ring) {
    for (auto const& corner : a.rings[ring]) {
      bool const is_there =
          std::ranges::any_of(b.rings[ring], [&](auto const& other) { return are_same(corner, other); });
      if (!is_there) return false;
    }
  }
  return true;
}

inline bool are_same(map::PropertyValue const& a, map::PropertyValue const& b) {
  if (a.index() != b.index()) return false;
  if (auto const* time = std::get_if<base::UtcTime>(&a))
    return std::chrono::abs(*time - std::get<base::UtcTime>(b)) <= std::chrono::milliseconds(1);
  if (auto const* real = std::get_if<double>(&a))
    return std::abs(*real - std::get<double>(b)) <= 1e-9 * std::abs(*real);
  return a == b;
}

/// Where two maps differ beyond what every format may lose ("slots-3: `name`"); empty where they do not.
inline std::string first_difference(MapContents const& wanted, MapContents const& found) {
  if (wanted.sites.size() != found.sites.size()) return "sites";
  for (auto const& [id, site] : wanted.sites) {
    auto const other = found.sites.find(id);
    if (other == found.sites.end() || other->second.floors().size() != site.floors().size()) return "site " + id;
    if (geo::distance_m(site.anchor(), other->second.anchor()) > 1e-3) return "anchor of " + id;
  }
  std::map<std::string, map::Feature const*> by_id;
  for (auto const& feature : found.features) by_id[feature.id] = &feature;
  if (wanted.features.size() != by_id.size())
    return fmt::format("{} features instead of {}", by_id.size(), wanted.features.size());
  for (auto const& feature : wanted.features) {
    auto const other = by_id.find(feature.id);
    if (other == by_id.end()) return feature.id + " is missing";
    auto const& read = *other->second;
    if (read.floor != feature.floor || read.site != feature.site || read.account.writer != feature.account.writer)
      return feature.id + ": whose";
    if (std::chrono::abs(read.account.at - feature.account.at) > std::chrono::milliseconds(1))
      return feature.id + ": when";
    auto const one = map::geometry_of(feature.content);
    auto const two = map::geometry_of(read.content);
    bool const is_same_place = std::visit(
        [](auto const& a, auto const& b) {
          if constexpr (std::is_same_v<decltype(a), decltype(b)>) return are_same(a, b);
          return false;
        },
        one, two);
    if (!is_same_place) return feature.id + ": geometry";
    for (auto const& property : map::properties_of(map::layer_of(feature.content))) {
      if (!are_same(property.get(feature.content), property.get(read.content)))
        return fmt::format("{}: `{}`", feature.id, property.name);
    }
  }
  return {};
}

}  // namespace lapwing::formats::testing
