#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mavlink/exchange/param.hpp"

namespace lapwing::parameters {

using mavlink::Parameter;

/// One parameter in which two lists differ; nothing where the list lacks it.
struct Difference {
  std::string name;
  std::optional<Parameter> first;
  std::optional<Parameter> second;
  friend bool operator==(Difference const&, Difference const&) = default;
};
/// In alphabetical order. Values are compared as the vehicle holds them.
[[nodiscard]] std::vector<Difference> differences(std::span<Parameter const> first, std::span<Parameter const> second);

/// Whether the value belongs to one vehicle and would be wrong on another: its system id, what its sensors were
/// calibrated to, its counters and the numbers of items that it holds.
[[nodiscard]] bool belongs_to_one_vehicle(std::string_view name);

/// Whether the name fits a pattern with `*` (any letters) and `?` (one); letter case does not matter.
[[nodiscard]] bool fits(std::string_view name, std::string_view pattern);
/// Whether it fits any; no patterns fit everything.
[[nodiscard]] bool fits_any(std::string_view name, std::span<std::string const> patterns);

}  // namespace lapwing::parameters
