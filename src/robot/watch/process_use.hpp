#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

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

/// The same for reports that are made all the time: looks once a second, by the wall's clock, whatever pace the loop's
/// time has.
class ProcessMeter {
 public:
  struct Use {
    std::uint64_t memory_bytes = 0;
    double cpu_share = 0;  ///< of one core, over the last second
  };
  [[nodiscard]] Use use();

 private:
  std::optional<std::chrono::steady_clock::time_point> looked_at_;
  ProcessUse seen_;
  Use use_;
};

}  // namespace lapwing::robot
