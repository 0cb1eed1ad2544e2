#pragma once

#include <string>

#include "base/time.hpp"

namespace lapwing::base {

/// ISO 8601 in UTC with milliseconds: "2001-09-09T01:46:40.007Z".
[[nodiscard]] std::string to_iso8601(UtcTime time);

}  // namespace lapwing::base
