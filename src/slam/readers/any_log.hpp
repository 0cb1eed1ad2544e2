#pragma once

#include <string_view>

#include "base/error.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

/// Reads a log in whichever of the known formats it is, told by its first line that is no comment. Errors:
/// invalid_input, with the line, or with what unpacks a packed file.
[[nodiscard]] base::Result<ScanLog> read_log(std::string_view text);

}  // namespace lapwing::slam
