#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lapwing::map {

/// The layers of vector tiles by name, of a JSON object with `vector_layers` (TileJSON 3, MBTiles 1.3, PMTiles 3);
/// those that are none are left out. Empty for another text.
[[nodiscard]] std::vector<std::string> vector_layers_of(std::string_view json);

}  // namespace lapwing::map
