#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "base/time.hpp"
#include "fleet/network/message_rates.hpp"
#include "fleet/network/telemetry_rate.hpp"
#include "fleet/state/questions.hpp"

namespace lapwing::fleet {

/// What this station has asked of a vehicle, and what has not come of it yet.
struct Asked {
  std::optional<std::uint32_t> mode;  ///< the last that this station commanded
  base::TimePoint mode_asked{};
  bool mission_mode_pending = false;  ///< we commanded the mission mode, and no heartbeat has shown what came of it
  unsigned armings = 0;               ///< how often this station has set out to arm it
  std::optional<base::TimePoint> arming_begun;  ///< by the operator's present command
  /// An arming was given up unanswered: if the vehicle carries it out before this, it is taken back.
  std::optional<base::TimePoint> may_arm_late_until;

  std::deque<Question> questions;  ///< once each
  bool is_questioning = false;
  bool has_asked_for_modes = false;
  std::optional<base::TimePoint> home_untold;  ///< when its home was last asked for in vain
  std::optional<MessageRates> rates;
  bool is_asking = false;    ///< message intervals are being asked for
  int intervals_untold = 0;  ///< times in a row that it refused to tell an interval
  TelemetryRate telemetry_rate;
};

}  // namespace lapwing::fleet
