#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "geo/position_json.hpp"
#include "map/features/feature.hpp"
#include "map/features/properties.hpp"

/// Features as GeoJSON (RFC 7946) and back. For .cpp files.
namespace lapwing::map {

using geo::Json;

/// By the anchor of its site: to 1e-9 degrees, a tenth of a millimetre. Outer rings go counterclockwise. What lies
/// across the antimeridian stays in one piece, its longitudes going on beyond 180 degrees. Among the properties are
/// site, floor, writer, at and, where there is any, held_over. Precondition: sound, and of this site.
[[nodiscard]] Json feature_json(Feature const& feature, geo::Site const& site);
[[nodiscard]] Json geometry_json(Geometry const& geometry, geo::Site const& site);
[[nodiscard]] Json property_json(PropertyValue const& value);

/// Limits of what is read at once: more is refused before anything is made of it.
inline constexpr std::size_t most_json_bytes = std::size_t{16} * 1024 * 1024;
inline constexpr std::size_t most_json_features = 10'000;

/// What stands for members that are missing.
struct FeatureDefaults {
  std::string id = {};
  std::string site = {};
  std::string floor = {};
  Account account = {};
};

/// Null: there is no such site.
using FindSite = std::function<geo::Site const*(std::string_view id)>;

/// Of a Feature or a FeatureCollection, each sound. A longitude may be in the next turn, a third coordinate is not
/// looked at, and of a Multi... there may be one part. Errors: invalid_input, with the place
/// ("features[3].geometry.coordinates[0][2][1] is 95, not a latitude"); not_found for a site that is not known.
[[nodiscard]] base::Result<std::vector<Feature>> read_features(std::string_view text, LayerKind layer,
                                                               FindSite const& find_site,
                                                               FeatureDefaults const& defaults);

/// For a column of text: `[{"property": "name", "writer": "drone 1", "at": "2026-..."}]`; empty for none.
[[nodiscard]] std::string held_over_text(std::vector<HeldOver> const& held_over);
/// Error: invalid_input.
[[nodiscard]] base::Result<std::vector<HeldOver>> held_over_of(std::string_view text);

}  // namespace lapwing::map
