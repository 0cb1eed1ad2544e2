#include "sim/words.hpp"

namespace lapwing::sim {

namespace {

constexpr Words ardupilot{.arming_refused = "Arm: ",
                          .unfit = "PreArm: ",
                          .armed = "Arming motors",
                          .disarmed_by_command = "Disarming motors",
                          .disarmed_after_landing = "Disarming motors"};

constexpr Words px4{.arming_refused = "Arming denied: ",
                    .unfit = "Preflight Fail: ",
                    .armed = "Armed by external command",
                    .disarmed_by_command = "Disarmed by external command",
                    .disarmed_after_landing = "Disarmed by landing"};

}  // namespace

Words const& words_of(Kind const& kind) {
  return kind.is_px4() ? px4 : ardupilot;
}

}  // namespace lapwing::sim
