#pragma once

#include "explore/known/known_map.hpp"

namespace lapwing::explore::testing {

/// A map that tests fill by rectangles.
struct LearntMap {
  KnownMap map;

  /// Both corners included.
  void learn(Cell least, Cell most, Knowledge knowledge) {
    for (int y = least.y; y <= most.y; ++y) {
      for (int x = least.x; x <= most.x; ++x) map.learn({x, y}, knowledge);
    }
  }
};

}  // namespace lapwing::explore::testing
