#pragma once

#include <string>

namespace lapwing::base {

/// With a question mark for every control character, line ends and those of Latin 1 in UTF-8 included: texts come from
/// vehicles, and on a terminal such characters forge lines and do worse.
[[nodiscard]] std::string printable(std::string text);

}  // namespace lapwing::base
