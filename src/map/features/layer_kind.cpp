#include "map/features/layer_kind.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::map {

std::string_view name_of(LayerKind layer) {
  switch (layer) {
    case LayerKind::slots: return "slots";
    case LayerKind::walls: return "walls";
    case LayerKind::points_of_interest: return "points_of_interest";
    case LayerKind::pictures: return "pictures";
    case LayerKind::tracks: return "tracks";
    case LayerKind::areas: return "areas";
  }
  std::unreachable();
}

std::optional<LayerKind> layer_named(std::string_view name) {
  auto const found = std::ranges::find(all_layers, name, [](LayerKind layer) { return name_of(layer); });
  return found == all_layers.end() ? std::nullopt : std::optional(*found);
}

}  // namespace lapwing::map
