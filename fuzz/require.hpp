#pragma once

#include <cstdlib>

namespace lapwing::fuzz {

/// What must hold for every input; the fuzzer keeps the one for which it does not.
inline void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace lapwing::fuzz
