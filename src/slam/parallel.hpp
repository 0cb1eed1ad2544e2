#pragma once

#include <cstddef>
#include <functional>

namespace lapwing::slam {

/// Calls the function once for each number below the count, in any order and on any threads, and returns when all are
/// done. What is called writes to its own place only, so that results do not depend on who does the calling.
using ForEach = std::function<void(std::size_t count, std::function<void(std::size_t index)> const& work)>;

/// One after the other.
inline void one_by_one(std::size_t count, std::function<void(std::size_t)> const& work) {
  for (std::size_t index = 0; index < count; ++index) work(index);
}

}  // namespace lapwing::slam
