#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"

/// Lists of numbers as one text with blanks between: what GIS files and tables have no column for.
namespace lapwing::map {

/// Each with as many digits as it takes to read the same number: "0.1 2 30.25".
[[nodiscard]] std::string text_of(std::span<double const> numbers);
/// Nothing when one of them is no finite number.
[[nodiscard]] std::optional<std::vector<double>> numbers_of(std::string_view text);

/// In seconds, exactly: "0 0.2 0.400000001".
[[nodiscard]] std::string text_of(std::span<base::Duration const> durations);
/// Nothing when one of them is no time, or longer than 30 years; decimals beyond nanoseconds are cut.
[[nodiscard]] std::optional<std::vector<base::Duration>> durations_of(std::string_view text);

}  // namespace lapwing::map
