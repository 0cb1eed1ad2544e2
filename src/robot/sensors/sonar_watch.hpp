#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/board_time.hpp"
#include "firmware/frames/description.hpp"

namespace lapwing::robot {

/// What is wrong with a sensor. One at a time, the worst.
enum class SensorFault {
  none,
  dropouts,  ///< it is not heard, or half of the time
  stuck,     ///< it says the same though what it looks at must have changed
  jumping,   ///< it says what cannot be, or one thing and another in turns
};

/// Whether what such a sonar says is taken for true: what it drops is missing, and what it says is right.
[[nodiscard]] constexpr bool is_believed(SensorFault fault) {
  return fault == SensorFault::none || fault == SensorFault::dropouts;
}

/// How far the body has gone and turned since it began, each way counted up.
struct MovedSoFar {
  double way_m = 0;
  double turn_rad = 0;
};

/// Looks at one sonar's echoes, ten a second.
///
/// Stuck: the same echo to the microsecond over a turn of 30 degrees, or, where it looks ahead or back, over half a
/// metre. A wall beside the way may well stay at one distance, and sonars that count inches say so in the same words.
/// Jumping: four changes of direction within the last ten echoes, each by more than the body can explain. Dropouts:
/// half of the last twenty missing while the others are all within a metre of each other: that is one near thing, heard
/// now and then.
class SonarWatch {
 public:
  explicit SonarWatch(firmware::SonarPlace const& place) : place_(place) {}

  [[nodiscard]] SensorFault feed(std::uint16_t echo_us, MovedSoFar const& moved);

 private:
  static constexpr std::size_t remembered = 20;
  [[nodiscard]] bool is_stuck(std::uint16_t echo_us, MovedSoFar const& moved);
  [[nodiscard]] bool is_jumping() const;
  [[nodiscard]] bool drops_out() const;
  /// The echo `ago` readings ago.
  [[nodiscard]] std::uint16_t echo(std::size_t ago) const {
    return echoes_[(next_ + remembered - 1 - ago) % remembered];
  }

  firmware::SonarPlace place_;
  std::array<std::uint16_t, remembered> echoes_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  std::optional<std::uint16_t> same_echo_;
  MovedSoFar same_since_;
};

}  // namespace lapwing::robot
