#pragma once

#include <array>
#include <string_view>

namespace lapwing::dolphin {

/// What `pick { type '...' }` usually asks for. A platform may have others.
inline constexpr auto vehicle_types = std::to_array<std::string_view>({"UAV", "UGV", "USV", "UUV"});

}  // namespace lapwing::dolphin
