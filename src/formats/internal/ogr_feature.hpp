#pragma once

#include <string>
#include <utility>
#include <vector>

#include <ogr_feature.h>

#include "base/error.hpp"
#include "formats/internal/field_values.hpp"
#include "geo/site.hpp"
#include "map/features/feature.hpp"
#include "map/features/properties.hpp"

/// Features as rows of GIS files: id, site, floor, writer, time, and the properties of the one table.
namespace lapwing::formats::internal {

/// That the features of a layer have in common.
[[nodiscard]] OGRwkbGeometryType geometry_type_of(map::LayerKind layer);

void define_feature(OGRFeatureDefn& definition, map::LayerKind layer, Times times);
/// Precondition: the row has the fields of `define_feature`, in their order.
void write_feature(OGRFeature& row, map::Feature const& feature, geo::Site const& site, Times times);

/// Reads rows of one layer of a file, whose fields it has looked up by name, in any case of letters.
class FeatureReader {
 public:
  FeatureReader(map::LayerKind layer, OGRFeatureDefn const& definition);

  /// What the row says; empty: nothing.
  [[nodiscard]] std::string site_of(OGRFeature const& row) const;
  /// `account`: of rows that name no writer or time. Error, invalid_input: a row that is no sound feature of the layer.
  [[nodiscard]] base::Result<map::Feature> read(OGRFeature const& row, geo::Site const& site,
                                                map::Account const& account) const;

 private:
  [[nodiscard]] std::string text(OGRFeature const& row, int field) const;

  map::LayerKind layer_;
  int id_;
  int site_;
  int floor_;
  int writer_;
  int at_;
  std::vector<std::pair<map::Property const*, int>> properties_;
};

}  // namespace lapwing::formats::internal
