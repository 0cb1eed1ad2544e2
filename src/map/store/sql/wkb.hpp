#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "map/store/sql/value.hpp"

/// Well-known binary (OGC 06-103r4, section 8), alone and in the wrappings of GeoPackage and PostGIS.
namespace lapwing::map::sql {

struct LonLat {
  double lon_deg = 0.0;
  double lat_deg = 0.0;
  friend bool operator==(LonLat const&, LonLat const&) = default;
};
using LonLatLine = std::vector<LonLat>;
/// Rings that end with the corner they begin with.
using LonLatArea = std::vector<LonLatLine>;
using LonLatGeometry = std::variant<LonLat, LonLatLine, LonLatArea>;

[[nodiscard]] Shape shape_of(LonLatGeometry const& geometry);
/// Nothing for what is no WKB of a point, line string or polygon in two dimensions.
[[nodiscard]] std::optional<LonLatGeometry> read_wkb(std::string_view wkb);

/// GeoPackage 1.3, section 2.1.3.
[[nodiscard]] std::string geopackage_blob(Shape const& shape);
/// The sides that the header of such a blob tells of; nothing without them. The WKB of what it gives is empty.
[[nodiscard]] std::optional<Shape> envelope_of(std::string_view geopackage_blob);
/// PostGIS: WKB with the number of its reference system.
[[nodiscard]] std::string ewkb(Shape const& shape);
/// What is in any of the wrappings, or in none. Nothing for what is no sound shape.
[[nodiscard]] std::optional<Shape> unwrap(std::string_view bytes);

}  // namespace lapwing::map::sql
