#pragma once

#include <string_view>

#include "base/error.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

inline constexpr std::size_t four_rangers_columns = 8;

/// Reads what a small drone with four single rangers writes, a Crazyflie with its multi-ranger deck: lines of `t x y
/// yaw right front left back`, seconds, metres and radians; `#` begins a comment. Errors: invalid_input, with the line.
[[nodiscard]] base::Result<ScanLog> read_four_rangers(std::string_view text);

}  // namespace lapwing::slam
