#pragma once

#include <ogr_feature.h>

#include "base/error.hpp"
#include "geo/site.hpp"

/// Sites as features of the layer `sites`: a point at the anchor, with what of a site is no geometry in fields.
namespace lapwing::formats::internal {

inline constexpr char const* sites_layer = "sites";

void define_site(OGRFeatureDefn& definition);
/// Fills the fields of `define_site` and the geometry.
void write_site(OGRFeature& feature, geo::Site const& site);
/// Error, invalid_input: fields that make no site.
[[nodiscard]] base::Result<geo::Site> read_site(OGRFeature const& feature);

}  // namespace lapwing::formats::internal
