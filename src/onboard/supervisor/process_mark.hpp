#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

namespace lapwing::onboard {

/// One process for good: its number is given to another one sooner or later, its number and the moment at which it
/// began are not, as long as the machine is not started anew.
struct ProcessMark {
  std::string name;
  pid_t pid = 0;
  std::uint64_t began = 0;  ///< clock ticks since the machine's start
};

/// Nothing for a number that no process has, or one that has ended and waits to be asked how.
[[nodiscard]] std::optional<std::uint64_t> began_at(pid_t pid);
[[nodiscard]] bool still_runs(ProcessMark const& mark);
/// Of the machine's present start: marks of another one are nobody's.
[[nodiscard]] std::string boot_id();

}  // namespace lapwing::onboard
