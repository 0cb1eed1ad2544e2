#pragma once

#include <string_view>

#include "sim/model/kind.hpp"

namespace lapwing::sim {

/// What the two autopilots call the same events in status texts. Ground stations show them, and look for some.
struct Words {
  std::string_view arming_refused;  ///< the reason follows
  std::string_view unfit;           ///< repeated while it stands; the reason follows
  std::string_view armed;
  std::string_view disarmed_by_command;
  std::string_view disarmed_after_landing;
};
[[nodiscard]] Words const& words_of(Kind const& kind);

}  // namespace lapwing::sim
