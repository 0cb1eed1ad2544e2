#pragma once

#include <string_view>
#include <vector>

#include "vehicle/aged.hpp"
#include "vehicle/status_text.hpp"

namespace lapwing::vehicle {

/// The vehicle's own view of its health, as far as arming needs it.
struct Health {
  bool position_ok = false;  ///< the estimator has an absolute position and is not guessing
  bool prearm_ok = false;
};

/// Whether its motors may turn, and what it has against it.
struct Arming {
  Aged<bool> armed;
  Aged<Health> health;
  Aged<std::vector<std::string_view>> unhealthy;  ///< sensors that are there, enabled and sick
  std::vector<StatusText> reasons;  ///< why it refused to arm or would, newest last; empty when it would not
  bool is_in_trouble = false;       ///< by its own heartbeat, which calls its state critical or worse: a failsafe acts
};

}  // namespace lapwing::vehicle
