#include "formats/internal/ogr_feature.hpp"

#include <fmt/format.h>

#include "formats/internal/ogr_geometry.hpp"

namespace lapwing::formats::internal {

namespace {

using map::LayerKind;
using map::PropertyKind;

/// The fields that every feature has, before its properties.
constexpr int property_offset = 5;

}  // namespace

OGRwkbGeometryType geometry_type_of(LayerKind layer) {
  switch (layer) {
    case LayerKind::slots:
    case LayerKind::areas: return wkbPolygon;
    case LayerKind::walls:
    case LayerKind::tracks: return wkbLineString;
    case LayerKind::points_of_interest: return wkbPoint;
    case LayerKind::pictures: return wkbUnknown;  // a footprint where it is known, else a place
  }
  return wkbUnknown;
}

void define_feature(OGRFeatureDefn& definition, LayerKind layer, Times times) {
  for (auto const* name : {"id", "site", "floor", "writer"}) define(definition, name, PropertyKind::text, times);
  define(definition, "at", PropertyKind::time, times);
  for (auto const& property : map::properties_of(layer))
    define(definition, std::string(property.name), property.kind, times);
}

void write_feature(OGRFeature& row, map::Feature const& feature, geo::Site const& site, Times times) {
  row.SetGeometryDirectly(on_globe(map::geometry_of(feature.content), site).release());
  row.SetField(0, feature.id.c_str());
  row.SetField(1, feature.site.c_str());
  row.SetField(2, feature.floor.c_str());
  row.SetField(3, feature.account.writer.c_str());
  write_field(row, 4, feature.account.at, times);
  int field = property_offset;
  for (auto const& property : map::properties_of(map::layer_of(feature.content)))
    write_field(row, field++, property.get(feature.content), times);
}

FeatureReader::FeatureReader(LayerKind layer, OGRFeatureDefn const& definition)
    : layer_(layer),
      id_(definition.GetFieldIndex("id")),
      site_(definition.GetFieldIndex("site")),
      floor_(definition.GetFieldIndex("floor")),
      writer_(definition.GetFieldIndex("writer")),
      at_(definition.GetFieldIndex("at")) {
  for (auto const& property : map::properties_of(layer)) {
    int const field = definition.GetFieldIndex(std::string(property.name).c_str());
    if (field >= 0) properties_.emplace_back(&property, field);
  }
}

std::string FeatureReader::text(OGRFeature const& row, int field) const {
  return field < 0 ? std::string() : std::string(row.GetFieldAsString(field));
}

std::string FeatureReader::site_of(OGRFeature const& row) const {
  return text(row, site_);
}

base::Result<map::Feature> FeatureReader::read(OGRFeature const& row, geo::Site const& site,
                                               map::Account const& account) const {
  auto geometry = in_site(*row.GetGeometryRef(), site);
  if (!geometry) return std::unexpected(geometry.error());
  auto content = map::content_at(layer_, std::move(*geometry));
  if (!content) return std::unexpected(content.error());
  for (auto const& [property, field] : properties_) {
    auto const value = read_field(row, field, property->kind);
    if (!value) return std::unexpected(value.error());
    if (auto const set = property->set(*content, *value); !set)
      return base::fail(base::ErrorKind::invalid_input, fmt::format("`{}` {}", property->name, set.error().message));
  }
  map::Feature feature{.id = text(row, id_),
                       .site = site.id(),
                       .floor = text(row, floor_),
                       .account = account,
                       .content = std::move(*content)};
  if (feature.id.empty()) feature.id = fmt::format("{}-{}", map::name_of(layer_), row.GetFID());
  if (auto writer = text(row, writer_); !writer.empty()) feature.account.writer = std::move(writer);
  if (at_ >= 0) {
    auto const at = read_field(row, at_, PropertyKind::time);
    if (!at) return std::unexpected(at.error());
    if (auto const* time = std::get_if<base::UtcTime>(&*at)) feature.account.at = *time;
  }
  if (auto const fault = map::feature_fault(feature)) return base::fail(base::ErrorKind::invalid_input, *fault);
  return feature;
}

}  // namespace lapwing::formats::internal
