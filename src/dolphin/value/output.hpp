#pragma once

#include <string>
#include <string_view>

#include "base/async/task.hpp"
#include "base/error.hpp"

namespace lapwing::dolphin {

/// Where a script's own words go and where it asks for others: standard output and input, or a browser.
class Output {
 public:
  virtual ~Output() = default;
  /// Text as it is, line ends included: `message`, `println`, `print`.
  virtual void write(std::string_view text) = 0;
  /// Shows the prompt and reads one line, its end not included; fails with `io` at the end of the input.
  [[nodiscard]] virtual base::Task<base::Result<std::string>> ask(std::string prompt) = 0;
};

}  // namespace lapwing::dolphin
