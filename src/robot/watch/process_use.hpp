#pragma once

#include <cstdint>

#include "base/time.hpp"

namespace lapwing::robot {

/// What this process has taken of the machine.
struct ProcessUse {
  std::uint64_t memory_bytes = 0;  ///< resident
  base::Duration cpu{};            ///< of all its threads, since it started
};

[[nodiscard]] ProcessUse process_use();

/// The part of one core between two looks; zero where no time passed.
[[nodiscard]] double cpu_share(ProcessUse const& before, ProcessUse const& after, base::Duration between);

}  // namespace lapwing::robot
