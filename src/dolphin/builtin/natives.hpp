#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/async/task.hpp"
#include "dolphin/value/fault.hpp"
#include "dolphin/value/value.hpp"

namespace lapwing::dolphin {

class Fiber;
struct Runtime;

/// One instruction of the language that is carried out here. At least one of `call` and `start` is set;
/// where both are, guards, which cannot wait, get `call`.
struct Native {
  using Arguments = std::span<Value const>;
  std::string_view name;
  int least = 0;  ///< arguments
  int most = 0;
  /// Does it at once.
  Checked<Value> (*call)(Runtime&, Fiber&, Arguments) = nullptr;
  /// Suspends the calling fiber until the task has ended.
  base::Task<Checked<Value>> (*start)(Runtime&, Fiber&, std::vector<Value>) = nullptr;
  bool is_pure = false;  ///< depends on its arguments alone: allowed in the answer to `ask`
};

inline constexpr int any_number = 255;

/// All of them; the index is the operand of Op::call_native.
[[nodiscard]] std::span<Native const> natives();
[[nodiscard]] std::optional<int> find_native(std::string_view name);

}  // namespace lapwing::dolphin
