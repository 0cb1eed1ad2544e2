#pragma once

#include <cstddef>

namespace lapwing::vehicle {

/// Of the places to park that a survey drone has found.
struct SlotCounts {
  std::size_t free = 0;
  std::size_t taken = 0;
  std::size_t unknown = 0;
  friend bool operator==(SlotCounts const&, SlotCounts const&) = default;
};

}  // namespace lapwing::vehicle
