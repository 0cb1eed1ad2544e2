#include "map/store/sql/wkb.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace lapwing::map::sql {

namespace {

static_assert(std::endian::native == std::endian::little, "shapes are written as they lie in memory");

constexpr std::uint32_t point_type = 1;
constexpr std::uint32_t line_type = 2;
constexpr std::uint32_t polygon_type = 3;
constexpr std::uint32_t has_srid = 0x2000'0000;
constexpr std::uint32_t wgs84 = 4326;
constexpr char little_endian = 1;
/// Of GeoPackage's header: little endian, with an envelope of x and y, or with none.
constexpr char with_envelope = 0b0000'0011;
constexpr char without_envelope = 0b0000'0001;

template <class T>
void append(std::string& to, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  to.append(bytes, sizeof(T));
}

void append_line(std::string& to, LonLatLine const& line) {
  append(to, static_cast<std::uint32_t>(line.size()));
  for (auto const& point : line) {
    append(to, point.lon_deg);
    append(to, point.lat_deg);
  }
}

/// Reads from the front; once it has failed it gives nothing but nothings.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  std::optional<T> take() {
    if (rest_.size() < sizeof(T)) return std::nullopt;
    char bytes[sizeof(T)];
    std::ranges::copy(rest_.substr(0, sizeof(T)), bytes);
    rest_.remove_prefix(sizeof(T));
    if (is_big_endian_) std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
  }
  /// The byte that says which end comes first.
  bool take_order() {
    auto const order = take<std::uint8_t>();
    if (!order || *order > 1) return false;
    is_big_endian_ = *order == 0;
    return true;
  }
  std::optional<LonLat> point() {
    auto const lon = take<double>(), lat = take<double>();
    if (!lon || !lat || !std::isfinite(*lon) || !std::isfinite(*lat)) return std::nullopt;
    return LonLat{*lon, *lat};
  }
  std::optional<LonLatLine> line() {
    auto const count = take<std::uint32_t>();
    // No more than there are bytes for: a count alone shall not take memory.
    if (!count || *count > rest_.size() / (2 * sizeof(double))) return std::nullopt;
    LonLatLine line(*count);
    for (auto& place : line) {
      auto const read = point();
      if (!read) return std::nullopt;
      place = *read;
    }
    return line;
  }
  std::optional<LonLatArea> area() {
    auto const count = take<std::uint32_t>();
    if (!count || *count > rest_.size() / sizeof(std::uint32_t)) return std::nullopt;
    LonLatArea area(*count);
    for (auto& ring : area) {
      auto read = line();
      if (!read) return std::nullopt;
      ring = std::move(*read);
    }
    return area;
  }
  [[nodiscard]] bool is_at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
  bool is_big_endian_ = false;
};

struct Bounds {
  double least_lon = std::numeric_limits<double>::infinity();
  double most_lon = -std::numeric_limits<double>::infinity();
  double least_lat = std::numeric_limits<double>::infinity();
  double most_lat = -std::numeric_limits<double>::infinity();

  void add(LonLat const& place) {
    least_lon = std::min(least_lon, place.lon_deg);
    most_lon = std::max(most_lon, place.lon_deg);
    least_lat = std::min(least_lat, place.lat_deg);
    most_lat = std::max(most_lat, place.lat_deg);
  }
  void add(LonLatLine const& line) {
    for (auto const& place : line) add(place);
  }
  void add(LonLatArea const& area) {
    for (auto const& ring : area) add(ring);
  }
};

std::string wkb_of(LonLatGeometry const& geometry) {
  std::string wkb(1, little_endian);
  if (auto const* place = std::get_if<LonLat>(&geometry)) {
    append(wkb, point_type);
    append(wkb, place->lon_deg);
    append(wkb, place->lat_deg);
  } else if (auto const* line = std::get_if<LonLatLine>(&geometry)) {
    append(wkb, line_type);
    append_line(wkb, *line);
  } else {
    auto const& area = std::get<LonLatArea>(geometry);
    append(wkb, polygon_type);
    append(wkb, static_cast<std::uint32_t>(area.size()));
    for (auto const& ring : area) append_line(wkb, ring);
  }
  return wkb;
}

/// The WKB behind a header of GeoPackage; nothing for a header that is none.
std::optional<std::string_view> behind_header(std::string_view blob) {
  if (blob.size() < 8 || blob[2] != 0) return std::nullopt;
  auto const flags = static_cast<unsigned>(static_cast<unsigned char>(blob[3]));
  constexpr std::size_t envelope_bytes[] = {0, 32, 48, 48, 64};
  auto const kind = (flags >> 1U) & 7U;
  if (kind >= std::size(envelope_bytes)) return std::nullopt;
  auto const header = 8 + envelope_bytes[kind];
  if (blob.size() < header) return std::nullopt;
  return blob.substr(header);
}

}  // namespace

Shape shape_of(LonLatGeometry const& geometry) {
  Bounds bounds;
  std::visit([&](auto const& part) { bounds.add(part); }, geometry);
  return {.wkb = wkb_of(geometry),
          .least_lon = bounds.least_lon,
          .most_lon = bounds.most_lon,
          .least_lat = bounds.least_lat,
          .most_lat = bounds.most_lat};
}

std::optional<LonLatGeometry> read_wkb(std::string_view wkb) {
  Reader reader(wkb);
  if (!reader.take_order()) return std::nullopt;
  auto const type = reader.take<std::uint32_t>();
  if (!type) return std::nullopt;
  if ((*type & has_srid) != 0 && !reader.take<std::uint32_t>()) return std::nullopt;
  auto const whole = [&](auto const& read) -> std::optional<LonLatGeometry> {
    if (!read || !reader.is_at_end()) return std::nullopt;
    return LonLatGeometry(*read);
  };
  switch (*type & ~has_srid) {
    case point_type: return whole(reader.point());
    case line_type: return whole(reader.line());
    case polygon_type: return whole(reader.area());
    default: return std::nullopt;
  }
}

std::string geopackage_blob(Shape const& shape) {
  bool const is_point = shape.least_lon == shape.most_lon && shape.least_lat == shape.most_lat;
  std::string blob("GP");
  blob += '\0';  // version 1
  blob += is_point ? without_envelope : with_envelope;
  append(blob, wgs84);
  if (!is_point)
    for (double const side : {shape.least_lon, shape.most_lon, shape.least_lat, shape.most_lat}) append(blob, side);
  return blob + shape.wkb;
}

std::optional<Shape> envelope_of(std::string_view geopackage_blob) {
  constexpr std::size_t before = 8;
  if (geopackage_blob.size() < before + 4 * sizeof(double) || !geopackage_blob.starts_with("GP")) return std::nullopt;
  if (geopackage_blob[3] != with_envelope) return std::nullopt;
  double sides[4];
  std::memcpy(sides, geopackage_blob.data() + before, sizeof(sides));
  return Shape{.wkb = {}, .least_lon = sides[0], .most_lon = sides[1], .least_lat = sides[2], .most_lat = sides[3]};
}

std::string ewkb(Shape const& shape) {
  std::uint32_t type = 0;
  std::memcpy(&type, shape.wkb.data() + 1, sizeof(type));
  std::string bytes(1, little_endian);
  append(bytes, type | has_srid);
  append(bytes, wgs84);
  return bytes.append(shape.wkb, 1 + sizeof(type));
}

std::optional<Shape> unwrap(std::string_view bytes) {
  auto const wkb = bytes.starts_with("GP") ? behind_header(bytes) : bytes;
  if (!wkb) return std::nullopt;
  auto const geometry = read_wkb(*wkb);
  if (!geometry) return std::nullopt;
  auto shape = shape_of(*geometry);
  if (!std::isfinite(shape.least_lon)) return std::nullopt;  // it has no points
  return shape;
}

}  // namespace lapwing::map::sql
