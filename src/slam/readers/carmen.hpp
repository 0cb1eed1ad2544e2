#pragma once

#include <string_view>

#include "base/error.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

/// Reads a log of CARMEN (`.clf`, `.log`): FLASER and ROBOTLASER1 with the odometry that they hold, and the front
/// laser's offset of a PARAM line; every other line is passed over. Scans may come in any order and with any number of
/// beams; a last line that was cut off is left out. Errors: invalid_input, with the line.
[[nodiscard]] base::Result<ScanLog> read_carmen(std::string_view text);

}  // namespace lapwing::slam
