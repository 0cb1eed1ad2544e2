#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/map_contents.hpp"
#include "map/features/layer_kind.hpp"

namespace lapwing::formats {

/// A part of the globe in degrees; one whose west is greater than its east lies across the antimeridian.
struct DegreeBox {
  double west = 0.0;
  double south = 0.0;
  double east = 0.0;
  double north = 0.0;
};

/// Which part of a map goes into a file.
struct Choice {
  std::vector<map::LayerKind> layers = {};  ///< these alone; empty: all
  std::string site = {};                    ///< this one alone; empty: all
  std::string floor = {};                   ///< this one alone; empty: all
  std::optional<DegreeBox> within = {};     ///< what lies in it at least in part, each feature and grid whole
};

/// What of a map is chosen; its sites are those that are left with something, and the one that was asked for.
[[nodiscard]] MapContents chosen_of(MapContents contents, Choice const& choice);

}  // namespace lapwing::formats
