#include "map/features/properties.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "map/features/internal/property_access.hpp"
#include "map/features/internal/track_text.hpp"

namespace lapwing::map {

namespace {

using namespace internal;
using enum PropertyKind;

constexpr std::array slot_properties = {
    Property{"state", text, "What stands on it.", get_word<&Slot::state, slot_states>,
             set_word<&Slot::state, slot_states>, slot_states},
    Property{"taken_probability", real, "0 to 1, calibrated: of ten places at 0.9 nine are taken.",
             get_optional<&Slot::taken_probability>, set_optional<&Slot::taken_probability>},
    Property{"seen_at", time, "When a camera had it in view last.", get_optional<&Slot::seen_at>,
             set_optional<&Slot::seen_at>},
    Property{"seen_by", text, "The vehicle whose camera that was.", get_text<&Slot::seen_by>, set_text<&Slot::seen_by>},
    Property{"name", text, "What is painted on it.", get_text<&Slot::name>, set_text<&Slot::name>},
};

constexpr std::array wall_properties = {
    Property{"thickness_m", real, "From face to face; its line runs in the middle.", get_optional<&Wall::thickness_m>,
             set_optional<&Wall::thickness_m>},
    Property{"height_m", real, "Above the floor.", get_optional<&Wall::height_m>, set_optional<&Wall::height_m>},
};

constexpr std::array point_of_interest_properties = {
    Property{"height_m", real, "Above the floor.", get_real<&PointOfInterest::height_m>,
             set_real<&PointOfInterest::height_m>},
    Property{"kind", text, "\"door\", \"name tag\", whatever a person would call it.", get_text<&PointOfInterest::kind>,
             set_text<&PointOfInterest::kind>},
    Property{"name", text, "What it is called: \"221\".", get_text<&PointOfInterest::name>,
             set_text<&PointOfInterest::name>},
    Property{"text", text, "All that was read there.", get_text<&PointOfInterest::text>,
             set_text<&PointOfInterest::text>},
    Property{"picture", text, "Hash of a picture of it in the store.", get_text<&PointOfInterest::picture>,
             set_text<&PointOfInterest::picture>},
    Property{"facing_rad", real, "Out of the wall, counterclockwise from east.",
             get_optional<&PointOfInterest::facing_rad>, set_optional<&PointOfInterest::facing_rad>},
    Property{"confidence", real, "0 to 1.", get_optional<&PointOfInterest::confidence>,
             set_optional<&PointOfInterest::confidence>},
    Property{"covariance_xx_m2", real, "Of its place, eastwards; all three or none.", get_covariance<0, 0>,
             set_covariance<0, 0>},
    Property{"covariance_xy_m2", real, "Of its place, between east and north.", get_covariance<0, 1>,
             set_covariance<0, 1>},
    Property{"covariance_yy_m2", real, "Of its place, northwards.", get_covariance<1, 1>, set_covariance<1, 1>},
};

constexpr std::array picture_properties = {
    Property{"image", text, "Hash of the picture in the store.", get_text<&Picture::image>, set_text<&Picture::image>},
    Property{"thumbnail", text, "Hash of a small one in the store.", get_text<&Picture::thumbnail>,
             set_text<&Picture::thumbnail>},
    Property{"media_type", text, "What kind of file the picture is.", get_text<&Picture::media_type>,
             set_text<&Picture::media_type>, picture_media_types},
    Property{"width_px", integer, "0: not known.", get_integer<&Picture::width_px>, set_integer<&Picture::width_px>},
    Property{"height_px", integer, "0: not known.", get_integer<&Picture::height_px>, set_integer<&Picture::height_px>},
    Property{"taken_at", time, "When the shutter opened.", get_time<&Picture::taken_at>, set_time<&Picture::taken_at>},
    Property{"vehicle", text, "Which took it.", get_text<&Picture::vehicle>, set_text<&Picture::vehicle>},
    Property{"camera_x_m", real, "East of the site's anchor; only where the geometry is the footprint.", get_camera<0>,
             set_camera<0>},
    Property{"camera_y_m", real, "North of the site's anchor; only where the geometry is the footprint.", get_camera<1>,
             set_camera<1>},
    Property{"up_m", real, "Of the camera, above the site's anchor.", get_real<&Picture::up_m>,
             set_real<&Picture::up_m>},
    Property{"camera_qx", real,
             "Unit quaternion from the camera's frame (x right, y down, z ahead) to the site's (east, north, up); all "
             "four or none.",
             get_quaternion<0>, set_quaternion<0>},
    Property{"camera_qy", real, "As above.", get_quaternion<1>, set_quaternion<1>},
    Property{"camera_qz", real, "As above.", get_quaternion<2>, set_quaternion<2>},
    Property{"camera_qw", real, "The real part.", get_quaternion<3>, set_quaternion<3>},
};

constexpr std::array track_properties = {
    Property{"vehicle", text, "Whose track it is.", get_text<&Track::vehicle>, set_text<&Track::vehicle>},
    Property{"began_at", time, "When it was at the first point.", get_beginning, set_beginning},
    Property{"times_s", text, "For each point the seconds since then, with blanks between: \"0 0.2 0.4\".", get_times,
             set_times},
    Property{"ups_m", text, "For each point the height above the site's anchor, with blanks between.", get_heights,
             set_heights},
    Property{"thinning", integer,
             "How coarse it has become: 0 with all points, else with the first of each 2^(thinning - 4) seconds, and "
             "the last.",
             get_integer<&Track::thinning>, set_integer<&Track::thinning>},
};

constexpr std::array area_properties = {
    Property{"purpose", text, "wanted: look here; fence: stay within; no_go: stay out.",
             get_word<&Area::purpose, area_purposes>, set_word<&Area::purpose, area_purposes>, area_purposes},
    Property{"name", text, "What people call it.", get_text<&Area::name>, set_text<&Area::name>},
    Property{"lowest_m", real, "Above the site's anchor; it counts from there up.", get_optional<&Area::lowest_m>,
             set_optional<&Area::lowest_m>},
    Property{"highest_m", real, "Above the site's anchor; it counts up to there.", get_optional<&Area::highest_m>,
             set_optional<&Area::highest_m>},
};

std::unexpected<base::Error> other_geometry(LayerKind layer, std::string_view takes) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("the layer {} takes {}", name_of(layer), takes));
}

/// Files turn rings as their format has it; the corners of a picture go clockwise, seen from above.
std::vector<SitePoint> clockwise(SitePolygon const& polygon) {
  if (polygon.rings.empty()) return {};
  auto corners = polygon.rings.front();
  if (geo::is_counterclockwise(corners)) std::reverse(std::next(corners.begin()), corners.end());
  return corners;
}

base::Result<Content> picture_at(Geometry const& geometry) {
  if (auto const* point = std::get_if<SitePoint>(&geometry)) return Picture{.position = *point};
  auto const* polygon = std::get_if<SitePolygon>(&geometry);
  if (!polygon || polygon->rings.size() != 1)
    return other_geometry(LayerKind::pictures, "points, and polygons without holes (what is seen in the picture)");
  return Picture{.footprint = clockwise(*polygon)};
}

base::Result<Content> track_along(Geometry const& geometry) {
  auto const* line = std::get_if<LineString>(&geometry);
  if (!line) return other_geometry(LayerKind::tracks, "lines");
  Track track;
  for (auto const& point : line->points) track.samples.push_back({.position = point});
  return track;
}

}  // namespace

std::span<Property const> properties_of(LayerKind layer) {
  switch (layer) {
    case LayerKind::slots: return slot_properties;
    case LayerKind::walls: return wall_properties;
    case LayerKind::points_of_interest: return point_of_interest_properties;
    case LayerKind::pictures: return picture_properties;
    case LayerKind::tracks: return track_properties;
    case LayerKind::areas: return area_properties;
  }
  std::unreachable();
}

std::string_view name_of(PropertyKind kind) {
  switch (kind) {
    case boolean: return "boolean";
    case integer: return "integer";
    case real: return "real";
    case text: return "text";
    case time: return "time";
  }
  std::unreachable();
}

Property const* property_named(LayerKind layer, std::string_view name) {
  auto const properties = properties_of(layer);
  auto const found = std::ranges::find(properties, name, &Property::name);
  return found == properties.end() ? nullptr : &*found;
}

base::Result<Content> content_at(LayerKind layer, Geometry geometry) {
  auto* const polygon = std::get_if<SitePolygon>(&geometry);
  switch (layer) {
    case LayerKind::slots:
      if (!polygon) return other_geometry(layer, "polygons");
      return Slot{.outline = std::move(*polygon)};
    case LayerKind::areas:
      if (!polygon) return other_geometry(layer, "polygons");
      return Area{.outline = std::move(*polygon)};
    case LayerKind::walls:
      if (auto* line = std::get_if<LineString>(&geometry)) return Wall{.line = std::move(*line)};
      return other_geometry(layer, "lines");
    case LayerKind::points_of_interest:
      if (auto const* point = std::get_if<SitePoint>(&geometry)) return PointOfInterest{.position = *point};
      return other_geometry(layer, "points");
    case LayerKind::pictures: return picture_at(geometry);
    case LayerKind::tracks: return track_along(geometry);
  }
  std::unreachable();
}

}  // namespace lapwing::map
