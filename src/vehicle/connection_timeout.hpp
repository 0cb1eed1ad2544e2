#pragma once

#include <chrono>

#include "base/time.hpp"

namespace lapwing::vehicle {

/// A vehicle that has been silent for longer is lost, unless a script or a setting says another time for it.
inline constexpr base::Duration default_connection_timeout = std::chrono::seconds(20);

}  // namespace lapwing::vehicle
