#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "map/features/properties.hpp"
#include "map/live/live_map.hpp"
#include "station/http/http.hpp"
#include "station/map/geo_words.hpp"

namespace lapwing::station {

/// Which features of a layer are asked for.
struct FeatureQuery {
  map::LayerKind layer = map::LayerKind::slots;
  std::string site = {};   ///< empty: of all sites
  std::string floor = {};  ///< empty: of all floors
  std::optional<LonLatBox> box = {};
  Period period = {};  ///< of the account
  std::optional<std::string> writer = {};
  std::vector<std::pair<map::Property const*, std::string>> properties = {};  ///< which must have that value, as text
  std::size_t limit = 0;
  std::size_t offset = 0;

  static constexpr std::size_t usual_limit = 1'000;
  static constexpr std::size_t most = 10'000;  ///< at once; who asks for more gets so many and a link to the rest
};

/// Of an address: `site`, `floor`, `bbox`, `datetime`, `writer`, `limit`, `offset` and the properties of the layer; `f`
/// may be "json". Error, invalid_input: another parameter, or a value that is none.
[[nodiscard]] base::Result<FeatureQuery> feature_query(map::LayerKind layer, HttpRequest const& request);

struct FeaturePage {
  std::size_t matched = 0;                         ///< all that fit, on this page or not
  std::vector<map::FeatureRecord const*> records;  ///< valid until the map changes
};
/// In the order of sites, and in these of ids.
[[nodiscard]] FeaturePage find_features(map::LiveMap const& map, FeatureQuery const& query);

/// Whether a property has the value that an address names: "free", "0.30", "true", a time at any offset.
[[nodiscard]] bool is_value(map::PropertyValue const& value, std::string_view wanted);

}  // namespace lapwing::station
