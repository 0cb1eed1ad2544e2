#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace lapwing::map {

/// The layers of features, in the order of `Content`.
enum class LayerKind { slots, walls, points_of_interest, pictures, tracks, areas };

inline constexpr std::array all_layers = {LayerKind::slots,    LayerKind::walls,  LayerKind::points_of_interest,
                                          LayerKind::pictures, LayerKind::tracks, LayerKind::areas};

/// What it is called in addresses, tables and files: "slots", "points_of_interest".
[[nodiscard]] std::string_view name_of(LayerKind layer);
[[nodiscard]] std::optional<LayerKind> layer_named(std::string_view name);

}  // namespace lapwing::map
