#include "sim/model/status_texts.hpp"

namespace lapwing::sim {

namespace {

constexpr Words ardupilot{.arming_refused = "Arm: ",
                          .unfit = "PreArm: ",
                          .armed = "Arming motors",
                          .disarmed_by_command = "Disarming motors",
                          .disarmed_after_landing = "Disarming motors"};

/// Of ArduPlane and ArduRover.
constexpr Words throttled{.arming_refused = "Arm: ",
                          .unfit = "PreArm: ",
                          .armed = "Throttle armed",
                          .disarmed_by_command = "Throttle disarmed",
                          .disarmed_after_landing = "Throttle disarmed"};

constexpr Words px4{.arming_refused = "Arming denied: ",
                    .unfit = "Preflight Fail: ",
                    .armed = "Armed by external command",
                    .disarmed_by_command = "Disarmed by external command",
                    .disarmed_after_landing = "Disarmed by landing"};

}  // namespace

Words const& words_of(Kind const& kind) {
  using enum vehicle::Family;
  if (kind.is_px4()) return px4;
  return kind.family == plane || kind.family == rover ? throttled : ardupilot;
}

}  // namespace lapwing::sim
