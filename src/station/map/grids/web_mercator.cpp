#include "station/map/grids/web_mercator.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace lapwing::station {

namespace {

using std::numbers::pi;

std::optional<std::int64_t> number(std::string_view text) {
  std::int64_t value = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double latitude_deg(double y, double tiles) {
  return std::atan(std::sinh(pi * (1.0 - 2.0 * y / tiles))) * 180.0 / pi;
}

}  // namespace

std::optional<map::XyzTile> tile_address(std::string_view zoom, std::string_view x, std::string_view y) {
  auto const z = number(zoom);
  auto const column = number(x);
  auto const row = number(y);
  if (!z || !column || !row || *z < 0 || *z > map::highest_zoom) return std::nullopt;
  auto const tiles = std::int64_t{1} << *z;
  if (*column < 0 || *column >= tiles || *row < 0 || *row >= tiles) return std::nullopt;
  return map::XyzTile{static_cast<int>(*z), *column, *row};
}

LonLatBox bounds_of(map::XyzTile const& tile) {
  double const tiles = std::exp2(tile.zoom);
  return {.west = static_cast<double>(tile.x) / tiles * 360.0 - 180.0,
          .south = latitude_deg(static_cast<double>(tile.y + 1), tiles),
          .east = static_cast<double>(tile.x + 1) / tiles * 360.0 - 180.0,
          .north = latitude_deg(static_cast<double>(tile.y), tiles)};
}

map::XyzTile tile_at(int zoom, double lon_deg, double lat_deg) {
  constexpr double edge_deg = 85.051128779806604;
  double const tiles = std::exp2(zoom);
  double const lat_rad = std::clamp(lat_deg, -edge_deg, edge_deg) * pi / 180.0;
  double const x = (lon_deg + 180.0) / 360.0 * tiles;
  double const y = (1.0 - std::asinh(std::tan(lat_rad)) / pi) / 2.0 * tiles;
  auto const clamped = [tiles](double value) {
    return static_cast<std::int64_t>(std::clamp(std::floor(value), 0.0, tiles - 1.0));
  };
  return {zoom, clamped(x), clamped(y)};
}

}  // namespace lapwing::station
