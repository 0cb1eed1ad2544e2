#pragma once

#include <optional>

#include "base/time.hpp"

namespace lapwing::vehicle {

struct VehicleState;

/// How long a charge lasts, and how far that may be off.
struct Endurance {
  base::Duration time{};
  base::Duration error{};  ///< to either side; zero is the vehicle's own figure, which it gives without one

  [[nodiscard]] base::Duration shortest() const { return time > error ? time - error : base::Duration{}; }
  [[nodiscard]] base::Duration longest() const { return time + error; }
  friend bool operator==(Endurance const&, Endurance const&) = default;
};

/// How fast a battery empties.
struct Drain {
  double per_s = 0.0;  ///< share of a full charge in a second
  double error = 0.0;  ///< share of that value by which it may be wrong
};

/// How long `remaining` (0..1, as whole percents tell it) lasts at that drain. Nothing where it could as well be half
/// or twice the time, and beyond two days, for then nothing is drawn that matters.
[[nodiscard]] std::optional<Endurance> endurance(double remaining, Drain drain);

/// How long the present charge of the vehicle's first battery lasts in flight, or on the move for what does not fly:
/// as the vehicle itself tells while it flies, else by what this flight draws, else by what its last one drew. Nothing
/// as long as none of them is known.
[[nodiscard]] std::optional<Endurance> endurance_in_flight(VehicleState const& state);

}  // namespace lapwing::vehicle
