#include "station/map/geo_words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "map/features/placement.hpp"

namespace lapwing::station {

namespace {

std::unexpected<base::Error> wrong(std::string message, std::string hint) {
  return base::fail(base::ErrorKind::invalid_input, std::move(message), std::move(hint));
}

std::optional<double> finite_number(std::string_view text) {
  double value = 0.0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The same direction within [-180, 180).
double wrapped(double lon_deg) {
  double const turned = std::fmod(lon_deg + 180.0, 360.0);
  return (turned < 0.0 ? turned + 360.0 : turned) - 180.0;
}

/// Rectangles that do not cross the antimeridian, one or two of them.
std::vector<std::pair<double, double>> spans(LonLatBox const& box) {
  if (box.west <= box.east) return {{box.west, box.east}};
  return {{box.west, 180.0}, {-180.0, box.east}};
}

/// Longitudes may lie beyond +-180, as those of a site across the antimeridian do.
LonLatBox rectangle(double west, double south, double east, double north) {
  if (east - west >= 360.0) return {-180.0, south, 180.0, north};
  return {wrapped(west), south, east == 180.0 ? 180.0 : wrapped(east), north};
}

/// Grows round places.
class Bounds {
 public:
  explicit Bounds(geo::Site const& site) : site_(site) {}
  void add(map::SitePoint const& point) {
    auto const place = map::place_of(site_, point);
    west_ = std::min(west_, place.lon_deg());
    east_ = std::max(east_, place.lon_deg());
    south_ = std::min(south_, place.lat_deg());
    north_ = std::max(north_, place.lat_deg());
  }
  [[nodiscard]] LonLatBox box() const { return rectangle(west_, south_, east_, north_); }

 private:
  geo::Site const& site_;
  double west_ = 1e9;
  double east_ = -1e9;
  double south_ = 1e9;
  double north_ = -1e9;
};

/// Half the sides of the part of the globe, round the anchor, in which a site's map can lie; degrees.
struct Neighbourhood {
  double lat_deg;
  double lon_deg;  ///< 180: all the way round
};

Neighbourhood neighbourhood(geo::Site const& site) {
  constexpr double metres_a_degree = 110'000.0;  // the shortest degree of latitude has 110,574 m
  double const lat_deg = map::farthest_m / metres_a_degree;
  double const highest_deg = std::abs(site.anchor().lat_deg()) + lat_deg;
  if (highest_deg >= 89.0) return {lat_deg, 180.0};
  return {lat_deg, std::min(180.0, lat_deg / std::cos(highest_deg * std::numbers::pi / 180.0))};
}

/// So that it holds all of the rectangle, whose longitudes may lie beyond +-180.
void grow(std::optional<map::SiteBox>& reach, geo::Site const& site, LonLatBox const& part) {
  // Its edges are curves on the plane: of 100 km they leave the chord of an eighth by some metres.
  constexpr int steps = 8;
  for (int i = 0; i <= steps; ++i) {
    for (int k = 0; k <= steps; ++k) {
      auto const place = geo::Wgs84::from_degrees(part.south + (part.north - part.south) * i / steps,
                                                  part.west + (part.east - part.west) * k / steps);
      auto const point = map::point_of(site, place.lon_rad, place.lat_rad);
      if (!reach) reach = map::SiteBox{point, point};
      reach->least.v = reach->least.v.cwiseMin(point.v);
      reach->most.v = reach->most.v.cwiseMax(point.v);
    }
  }
}

}  // namespace

bool LonLatBox::meets(LonLatBox const& other) const {
  if (south > other.north || other.south > north) return false;
  for (auto const& [from, to] : spans(*this))
    for (auto const& [other_from, other_to] : spans(other))
      if (from <= other_to && other_from <= to) return true;
  return false;
}

base::Result<LonLatBox> lon_lat_box(std::string_view text) {
  constexpr std::string_view hint = "it is west,south,east,north in degrees, such as 7.43,46.94,7.46,46.96";
  std::vector<double> numbers;
  for (bool is_last = false; !is_last;) {
    auto const part = text.substr(0, text.find(','));
    is_last = part.size() == text.size();
    auto const number = finite_number(part);
    if (!number || numbers.size() == 6)
      return wrong(fmt::format("\"bbox\" has no number in place {}", numbers.size() + 1), std::string(hint));
    numbers.push_back(*number);
    if (!is_last) text.remove_prefix(part.size() + 1);
  }
  if (numbers.size() == 6) numbers = {numbers[0], numbers[1], numbers[3], numbers[4]};
  if (numbers.size() != 4)
    return wrong(fmt::format("\"bbox\" has {} numbers, not 4 or 6", numbers.size()), std::string(hint));
  LonLatBox const box{numbers[0], numbers[1], numbers[2], numbers[3]};
  bool const is_on_earth = std::abs(box.west) <= 180.0 && std::abs(box.east) <= 180.0 && std::abs(box.south) <= 90.0 &&
                           std::abs(box.north) <= 90.0;
  if (!is_on_earth) return wrong("\"bbox\" goes beyond the globe", std::string(hint));
  if (box.south > box.north) return wrong("\"bbox\" has its north below its south", std::string(hint));
  return box;
}

base::Result<Period> period(std::string_view text) {
  constexpr std::string_view hint =
      "it is a time as 2026-11-21T10:12:52Z, or two with a slash between them, of which one may be ..";
  auto const end = [](std::string_view part) -> std::optional<std::optional<base::UtcTime>> {
    if (part.empty() || part == "..") return std::optional<base::UtcTime>{};
    auto const time = base::utc_from_text(part);
    if (!time) return std::nullopt;
    return time;
  };
  auto const slash = text.find('/');
  auto const from = end(text.substr(0, slash));
  auto const to = slash == std::string_view::npos ? from : end(text.substr(slash + 1));
  if (!from || !to || (slash == std::string_view::npos && !*from))
    return wrong(fmt::format("\"datetime\" is no time or period"), std::string(hint));
  if (*from && *to && **to < **from) return wrong("\"datetime\" ends before it begins", std::string(hint));
  return Period{*from, *to};
}

SiteReach reach_of(LonLatBox const& box, geo::Site const& site) {
  auto const half = neighbourhood(site);
  double const lat_deg = site.anchor().lat_deg();
  double const lon_deg = site.anchor().lon_deg();
  double const south = std::max(box.south, lat_deg - half.lat_deg);
  double const north = std::min(box.north, lat_deg + half.lat_deg);
  if (south > north) return {.is_empty = true};
  if (half.lon_deg >= 180.0) return {};
  std::optional<map::SiteBox> reach;
  for (auto const& [from, to] : spans(box)) {
    for (double const turn_deg : {-360.0, 0.0, 360.0}) {
      double const west = std::max(from + turn_deg, lon_deg - half.lon_deg);
      double const east = std::min(to + turn_deg, lon_deg + half.lon_deg);
      if (west > east) continue;
      grow(reach, site, {west, south, east, north});
    }
  }
  if (!reach) return {.is_empty = true};
  Eigen::Vector2d const margin = Eigen::Vector2d::Constant(1.0 + 1e-3 * (reach->most - reach->least).length());
  reach->least.v -= margin;
  reach->most.v += margin;
  return {.box = reach};
}

LonLatBox lon_lat_bounds(map::Geometry const& geometry, geo::Site const& site) {
  Bounds bounds(site);
  struct Add {
    Bounds& bounds;
    void operator()(map::SitePoint const& point) const { bounds.add(point); }
    void operator()(map::LineString const& line) const {
      for (auto const& point : line.points) bounds.add(point);
    }
    void operator()(map::SitePolygon const& polygon) const {
      for (auto const& corner : polygon.rings.front()) bounds.add(corner);
    }
  };
  std::visit(Add{bounds}, geometry);
  return bounds.box();
}

LonLatBox lon_lat_bounds(map::SiteBox const& box, geo::Site const& site) {
  Bounds bounds(site);
  for (double const x : {box.least.x(), box.most.x()})
    for (double const y : {box.least.y(), box.most.y()}) bounds.add(map::SitePoint(x, y));
  return bounds.box();
}

}  // namespace lapwing::station
