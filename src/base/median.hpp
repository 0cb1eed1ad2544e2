#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lapwing::base {

/// The value in the middle; of an even number of values the upper one of the two. Precondition: there is one.
[[nodiscard]] inline double median(std::vector<double> values) {
  auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace lapwing::base
