#pragma once

#include <cstddef>
#include <functional>

namespace lapwing::base {

/// Calls `work` once for each number below `count`, on `threads` threads of which the caller's is one, and returns when
/// all are done: for programs that have nothing else to do meanwhile and no loop. Which thread takes which number is
/// open, so `work` writes to its own place alone. Precondition: at least one thread; `work` does not throw.
void parallel_for(unsigned threads, std::size_t count, std::function<void(std::size_t index)> const& work);

}  // namespace lapwing::base
