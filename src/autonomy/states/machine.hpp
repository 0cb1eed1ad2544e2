#pragma once

#include "autonomy/states/situation.hpp"
#include "autonomy/states/transitions.hpp"

namespace lapwing::autonomy {

/// Decides what the drone does: 20 times a second it is told all there is to know and says what is wanted. Values in,
/// values out; copying it copies all that it knows.
///
/// In each frame: Kill; then, once, what makes the drone come down; then the commands in their order, each in the state
/// that the one before led to; then what the state waits for. A command that leads nowhere is answered with why.
class Machine {
 public:
  /// Precondition: the heights are sound (`heights_fault`).
  explicit Machine(Options options = {}, HoverHeights heights = {});

  /// `now` never goes back.
  [[nodiscard]] Said step(Told const& told, base::TimePoint now);
  [[nodiscard]] Memory const& memory() const { return memory_; }

 private:
  Options options_;
  Memory memory_;
};

}  // namespace lapwing::autonomy
