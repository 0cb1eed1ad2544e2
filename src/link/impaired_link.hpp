#pragma once

#include <cstdint>
#include <memory>

#include "base/time.hpp"
#include "link/byte_link.hpp"

namespace lapwing::link {

/// What a bad radio does to each chunk, independently in each direction.
struct Impairment {
  double loss = 0.0;         ///< probability 0..1 that a chunk never arrives
  double duplication = 0.0;  ///< probability 0..1 that it arrives twice
  base::Duration delay{};    ///< every chunk is this late
  base::Duration jitter{};   ///< and up to this much later, evenly spread; chunks may overtake each other
  std::uint64_t seed = 1;    ///< the same seed loses the same chunks
};

/// `inner`, made bad. For the simulator and for tests.
[[nodiscard]] std::unique_ptr<ByteLink> impair(base::Loop& loop, std::unique_ptr<ByteLink> inner,
                                               Impairment impairment);

}  // namespace lapwing::link
