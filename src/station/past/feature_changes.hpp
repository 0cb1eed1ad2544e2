#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "map/store/store.hpp"

namespace lapwing::station {

/// Which features were added, changed and removed, by layer.
struct FeatureChanges {
  std::string layers;        ///< a JSON list of {layer, added, changed, removed}
  std::size_t left_out = 0;  ///< beyond the number that was asked for
};

/// Between two moments, each given by what leads to it (`map::Store::state_at`). A pure function.
///
/// What is newer, surer or seen by another one is no change: only what is shown elsewhere, or says something else. A
/// vehicle's track grows by itself and is not compared.
[[nodiscard]] FeatureChanges feature_changes(std::vector<map::Store::Shown> const& before,
                                             std::vector<map::Store::Shown> const& after, std::size_t most);

}  // namespace lapwing::station
