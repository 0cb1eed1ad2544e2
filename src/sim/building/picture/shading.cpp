#include "sim/building/picture/shading.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lapwing::sim::building {

namespace {

/// `std::floor` without a call into the library, which is most of a picture's time otherwise. For what fits.
std::int64_t whole_below(double value) {
  auto const whole = static_cast<std::int64_t>(value);
  return whole - (value < static_cast<double>(whole) ? 1 : 0);
}

/// From the nearest multiple of `spacing`, -spacing / 2 to spacing / 2.
double off_lattice(double value, double spacing) {
  return value - spacing * static_cast<double>(whole_below(value / spacing + 0.5));
}

constexpr double most_hashed = 65'535.0;

/// A whole number up to `most_hashed`, the same for the same whole numbers.
double hashed(std::int64_t x, std::int64_t y) {
  auto hash = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15U ^ static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fU;
  hash = (hash ^ (hash >> 29U)) * 0xbf58476d1ce4e5b9U;
  hash ^= hash >> 32U;
  return static_cast<double>(hash & 0xffffU);
}

/// Lattice noise from -1 to 1, a cell wide; fades where a pixel covers more than a cell.
double speckle(double x, double y, double cell_m, double spread_m) {
  double const fades = std::clamp(cell_m / std::max(spread_m, 1e-9) - 0.5, 0.0, 1.0);
  if (fades == 0.0) return 0.0;
  auto const column = whole_below(x / cell_m);
  auto const row = whole_below(y / cell_m);
  double const share_x = x / cell_m - static_cast<double>(column);
  double const share_y = y / cell_m - static_cast<double>(row);
  auto const between = [](double a, double b, double share) { return a + share * (b - a); };
  double const low = between(hashed(column, row), hashed(column + 1, row), share_x);
  double const high = between(hashed(column, row + 1), hashed(column + 1, row + 1), share_x);
  return fades * (2.0 / most_hashed * between(low, high, share_y) - 1.0);
}

/// How much of a pixel around `off` (metres from a line's middle) a line of that width covers.
double covered(double off_m, double width_m, double spread_m) {
  double const spread = std::max(spread_m, 1e-6);
  double const inside = std::clamp(0.5 + (width_m / 2.0 - std::abs(off_m)) / spread, 0.0, 1.0);
  return inside * std::min(1.0, width_m / spread);
}

/// Joints of tiles.
double joints(double x, double y, double tile_m, double width_m, double spread_m) {
  return std::max(covered(off_lattice(x, tile_m), width_m, spread_m),
                  covered(off_lattice(y, tile_m), width_m, spread_m));
}

Light light_of(Colour const& colour, double factor) {
  return {static_cast<float>(colour.red * factor), static_cast<float>(colour.green * factor),
          static_cast<float>(colour.blue * factor)};
}

Light mixed(Light const& a, Light const& b, double share_of_b) {
  return a + static_cast<float>(share_of_b) * (b - a);
}

Light sign_at_point(Surface const& surface, double x, double y, double spread_m) {
  constexpr double frame_m = 0.003;
  constexpr double line_m = 0.1;
  constexpr double margin_m = 0.035;
  Light const ink(0.1F, 0.12F, 0.2F);
  auto const& lettering = *surface.lettering;
  double const to_edge_m = std::min({x, y, lettering.width_m - x, lettering.height_m - y});
  Light light = light_of(surface.colour, 1.0);
  light = mixed(light, Light(0.7F, 0.71F, 0.73F), covered(to_edge_m, 2.0 * frame_m, spread_m));
  double const most = stroke_width / 2.0 + spread_m / letter_height_m;
  for (std::size_t i = 0; i < lettering.rows.size(); ++i) {
    auto const& row = lettering.rows[i];
    double const foot_m = lettering.height_m - margin_m - letter_height_m - static_cast<double>(i) * line_m;
    double const left_m = (lettering.width_m - row.width * letter_height_m) / 2.0;
    double const up = (y - foot_m) / letter_height_m;
    if (up < -0.5 - most || up > 1.2 + most) continue;
    double const off = distance_to_strokes(row, (x - left_m) / letter_height_m, up, most);
    light = mixed(light, ink, covered(off, stroke_width, spread_m / letter_height_m));
  }
  return light;
}

/// Lamps hang in rows: it is lighter under them.
double lamps(Eigen::Vector3d const& point) {
  constexpr double apart_m = 3.0;
  // A parabola through a cosine's peaks and zeros.
  auto const wave = [](double value) {
    double const off = off_lattice(value / apart_m, 1.0);
    return 1.0 - 8.0 * off * off;
  };
  return 1.0 + 0.04 * wave(point.x()) * wave(point.y());
}

/// Of an upright surface: one side of a building is lighter than the others, and it darkens towards the floor.
double upright_light(Surface const& surface, Eigen::Vector3d const& point) {
  double const from_window = surface.normal.x() * 0.76 + surface.normal.y() * 0.64;
  double const near_floor = std::clamp(point.z() / 0.4, 0.0, 1.0);
  return (0.92 + 0.08 * from_window) * (0.9 + 0.1 * near_floor);
}

Light solid_at_point(Surface const& surface, Eigen::Vector3d const& point, double x, double y, double spread_m) {
  constexpr double skirting_m = 0.08;
  constexpr Colour skirting{0.33, 0.34, 0.36};
  bool const is_level = std::abs(surface.normal.z()) > 0.5;
  double const lit = is_level ? 0.9 : upright_light(surface, point);
  switch (surface.look) {
    case Look::plaster:
      if (!is_level && point.z() < skirting_m) return light_of(skirting, lit);
      return light_of(surface.colour,
                      lit * (1.0 + 0.012 * speckle(x, y, 0.02, spread_m) + 0.015 * speckle(x, y, 0.7, spread_m)));
    case Look::wood:
      return light_of(surface.colour, lit * (1.0 + 0.05 * speckle(x, y * 0.05, 0.008, spread_m) +
                                             0.05 * speckle(x, y * 0.1, 0.05, spread_m)));
    case Look::metal: return light_of(surface.colour, lit);
    case Look::plain:
    case Look::skin: return light_of(surface.colour, lit * (1.0 + 0.02 * speckle(x, y, 0.03, spread_m)));
  }
  return {};
}

Light floor_at_point(Surface const& surface, Eigen::Vector3d const& point, double spread_m) {
  constexpr double tile_m = 0.5;
  double const grain = 0.06 * speckle(point.x(), point.y(), 0.01, spread_m);
  double const tile =
      0.03 * (hashed(whole_below(point.x() / tile_m), whole_below(point.y() / tile_m)) / most_hashed - 0.5);
  double const joint = joints(point.x(), point.y(), tile_m, 0.006, spread_m);
  return light_of(surface.colour, (1.0 + grain + tile) * (1.0 - 0.15 * joint));
}

Light ceiling_at_point(Surface const& surface, Eigen::Vector3d const& point, double spread_m) {
  constexpr double tile_m = 0.6;
  constexpr double lamps_apart_m = 3.0;
  bool const is_lamp =
      std::abs(off_lattice(point.x(), lamps_apart_m)) < 0.6 && std::abs(off_lattice(point.y(), lamps_apart_m)) < 0.15;
  if (is_lamp) return {1.15F, 1.15F, 1.1F};
  return light_of(surface.colour, 0.85 * (1.0 - 0.12 * joints(point.x(), point.y(), tile_m, 0.012, spread_m)));
}

}  // namespace

Light shade(Surface const& surface, Eigen::Vector3d const& point, double spread_m) {
  Eigen::Vector3d const from = point - surface.origin;
  double const x = from.dot(surface.across);
  double const y = from.dot(surface.up);
  Light light;
  switch (surface.kind) {
    case Surface::Kind::solid: light = solid_at_point(surface, point, x, y, spread_m); break;
    case Surface::Kind::floor: light = floor_at_point(surface, point, spread_m); break;
    case Surface::Kind::ceiling: light = ceiling_at_point(surface, point, spread_m); break;
    case Surface::Kind::sign:
      light = sign_at_point(surface, x, y, spread_m) * static_cast<float>(upright_light(surface, point));
      break;
  }
  return light * static_cast<float>(lamps(point));
}

}  // namespace lapwing::sim::building
