// Features of the map as GeoJSON: any bytes either are refused with a reason or give sound features, which come out
// of what is written of them as they are.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "map/features/feature_json.hpp"
#include "require.hpp"

namespace {

using namespace lapwing;
using fuzz::require;

geo::Site const& site() {
  static auto const site = *geo::Site::make("yard", geo::Wgs84::from_degrees(41.0, 179.999, 90.0));
  return site;
}

base::Result<std::vector<map::Feature>> read(std::string_view text, map::LayerKind layer) {
  using std::chrono::year;
  return map::read_features(
      text, layer, [](std::string_view id) { return id == "yard" ? &site() : nullptr; },
      {.id = "a", .site = "yard", .account = {"fuzz", std::chrono::sys_days(year(2026) / 1 / 1)}});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  if (size == 0) return 0;
  auto const layer = map::all_layers[data[0] % map::all_layers.size()];  // a letter of ASCII, so that seeds are texts
  auto const features = read({reinterpret_cast<char const*>(data + 1), size - 1}, layer);
  if (!features) {
    require(!features.error().message.empty());
    return 0;
  }
  for (auto const& feature : *features) {
    require(!map::feature_fault(feature) && map::layer_of(feature.content) == layer);
    auto const again = read(map::feature_json(feature, site()).dump(), layer);
    // Rounding may make edges touch that did not; all else holds.
    if (!again) continue;
    require(again->size() == 1 && again->front().id == feature.id && again->front().account == feature.account);
    for (auto const& property : map::properties_of(layer))
      require(property.get(again->front().content) == property.get(feature.content));
  }
  return 0;
}
