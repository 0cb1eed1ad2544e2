#pragma once

#include <algorithm>
#include <chrono>

namespace lapwing::station::internal {

/// How fast one session may ask. Who asks faster is read slower, so that the network holds it back, and the loop has
/// time for everybody else; nothing is lost. People and programs that fly never come near it.
class MessagePace {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double burst = 1000.0;
  static constexpr double per_s = 500.0;
  static constexpr std::chrono::milliseconds rest{20};

  /// Counts one message; how long to wait before the next is read.
  [[nodiscard]] std::chrono::milliseconds take(Clock::time_point now) {
    room_ = std::min(burst, room_ + std::chrono::duration<double>(now - taken_).count() * per_s) - 1.0;
    taken_ = now;
    return room_ < 0.0 ? rest : std::chrono::milliseconds(0);
  }

 private:
  double room_ = burst;
  Clock::time_point taken_{};
};

}  // namespace lapwing::station::internal
