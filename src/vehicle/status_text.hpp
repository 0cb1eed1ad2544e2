#pragma once

#include <string>

#include "base/time.hpp"

namespace lapwing::vehicle {

/// Something that a vehicle said in words.
struct StatusText {
  int severity = 6;  ///< MAVLink / syslog: 0 emergency .. 7 debug
  std::string text;
  base::TimePoint heard{};
  int component = 1;  ///< who said it; 1 is the autopilot
};

}  // namespace lapwing::vehicle
