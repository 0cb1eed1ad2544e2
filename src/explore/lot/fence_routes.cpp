#include "explore/lot/fence_routes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace lapwing::explore {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Beside each corner so many places are tried, so much farther from it than the margin.
constexpr int places_a_corner = 8;
constexpr double beyond_margin = 1.3;

double distance_to_segment_m(map::SitePoint const& place, map::SitePoint const& a, map::SitePoint const& b) {
  auto const edge = b - a;
  double const square = edge.dot(edge);
  double const share = square > 0.0 ? std::clamp((place - a).dot(edge) / square, 0.0, 1.0) : 0.0;
  return geo::distance_m(place, a + share * edge);
}

bool do_cross(map::SitePoint const& a, map::SitePoint const& b, map::SitePoint const& c, map::SitePoint const& d) {
  auto const side = [](auto const& p, auto const& q, auto const& r) { return (q - p).cross(r - p) > 0.0; };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

double distance_between_m(map::SitePoint const& a, map::SitePoint const& b, map::SitePoint const& c,
                          map::SitePoint const& d) {
  if (do_cross(a, b, c, d)) return 0.0;
  return std::min({distance_to_segment_m(a, c, d), distance_to_segment_m(b, c, d), distance_to_segment_m(c, a, b),
                   distance_to_segment_m(d, a, b)});
}

}  // namespace

base::Result<FenceRoutes> FenceRoutes::make(geo::Polygon<geo::SiteFrame> fence, double margin_m) {
  using base::ErrorKind;
  if (auto const fault = geo::polygon_fault(fence))
    return base::fail(ErrorKind::invalid_input, fmt::format("the fence is no area: {}", *fault));
  std::size_t corners = 0;
  for (auto const& ring : fence.rings) corners += ring.size();
  if (corners > most_corners)
    return base::fail(ErrorKind::invalid_input,
                      fmt::format("the fence has {} corners, and a survey takes {}", corners, most_corners),
                      "draw it with fewer");
  if (!(margin_m > 0.0) || !std::isfinite(margin_m))
    return base::fail(ErrorKind::invalid_input, fmt::format("a margin of {} m within the fence is none", margin_m));
  return FenceRoutes(std::move(fence), margin_m);
}

FenceRoutes::FenceRoutes(geo::Polygon<geo::SiteFrame> fence, double margin_m)
    : fence_(std::move(fence)), margin_m_(margin_m) {
  find_bends();
}

bool FenceRoutes::contains(map::SitePoint const& place) const {
  return geo::contains(fence_, place) && geo::distance_to_edge_m(fence_, place) >= margin_m_;
}

bool FenceRoutes::is_clear(map::SitePoint const& from, map::SitePoint const& to, double margin_m) const {
  for (auto const& ring : fence_.rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (distance_between_m(from, to, ring[i], ring[(i + 1) % ring.size()]) < margin_m) return false;
  return true;
}

void FenceRoutes::find_bends() {
  for (auto const& ring : fence_.rings) {
    for (auto const& corner : ring) {
      for (int i = 0; i < places_a_corner; ++i) {
        double const way = 2.0 * std::numbers::pi * i / places_a_corner;
        auto const place =
            corner + geo::Vector<geo::SiteFrame>(std::cos(way), std::sin(way)) * (beyond_margin * margin_m_);
        if (contains(place)) bends_.push_back(place);
      }
    }
  }
  auto const count = bends_.size();
  between_m_.assign(count, std::vector<double>(count, infinite));
  next_.assign(count, std::vector<std::size_t>(count, count));
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < count; ++b) {
      next_[a][b] = b;
      if (a == b || is_clear(bends_[a], bends_[b], margin_m_)) between_m_[a][b] = geo::distance_m(bends_[a], bends_[b]);
    }
  }
  // Floyd 1962, Warshall 1962.
  for (std::size_t over = 0; over < count; ++over) {
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = 0; b < count; ++b) {
        double const way_m = between_m_[a][over] + between_m_[over][b];
        if (way_m >= between_m_[a][b]) continue;
        between_m_[a][b] = way_m;
        next_[a][b] = next_[a][over];
      }
    }
  }
}

std::vector<map::SitePoint> FenceRoutes::route(map::SitePoint const& from, map::SitePoint const& to) const {
  if (!contains(to) || !geo::contains(fence_, from)) return {};
  // Who is nearer to an edge than the margin may come away from it, straight.
  double const from_margin_m = std::min(margin_m_, 0.999 * geo::distance_to_edge_m(fence_, from));
  if (is_clear(from, to, from_margin_m)) return {to};
  std::vector<std::size_t> last;
  for (std::size_t i = 0; i < bends_.size(); ++i)
    if (is_clear(bends_[i], to, margin_m_)) last.push_back(i);
  double least_m = infinite;
  std::size_t first = 0;
  std::size_t end = 0;
  for (std::size_t a = 0; a < bends_.size(); ++a) {
    if (!is_clear(from, bends_[a], from_margin_m)) continue;
    for (auto const b : last) {
      double const way_m = geo::distance_m(from, bends_[a]) + between_m_[a][b] + geo::distance_m(bends_[b], to);
      if (way_m >= least_m) continue;
      least_m = way_m;
      first = a;
      end = b;
    }
  }
  std::vector<map::SitePoint> places;
  if (least_m == infinite) return places;
  for (auto at = first; at != end; at = next_[at][end]) places.push_back(bends_[at]);
  places.push_back(bends_[end]);
  places.push_back(to);
  return places;
}

double route_length_m(map::SitePoint const& from, std::vector<map::SitePoint> const& route) {
  if (route.empty()) return infinite;
  double way_m = geo::distance_m(from, route.front());
  for (std::size_t i = 1; i < route.size(); ++i) way_m += geo::distance_m(route[i - 1], route[i]);
  return way_m;
}

}  // namespace lapwing::explore
