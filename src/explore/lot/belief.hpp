#pragma once

#include <algorithm>
#include <cmath>

#include "base/time.hpp"

/// Arithmetic of what is believed of yes-or-no questions: whether a slot is taken, whether a place is for parking.
namespace lapwing::explore {

[[nodiscard]] inline double log_odds_of(double chance) {
  return std::log(chance / (1.0 - chance));
}
[[nodiscard]] inline double chance_of(double log_odds) {
  return 1.0 / (1.0 + std::exp(-log_odds));
}

/// What is not known of a question with that chance, in bits (Shannon 1948): 1 at a half, 0 for what is sure.
[[nodiscard]] inline double entropy_bits(double chance) {
  if (chance <= 0.0 || chance >= 1.0) return 0.0;
  return -chance * std::log2(chance) - (1.0 - chance) * std::log2(1.0 - chance);
}

/// What one look that errs with chance `error` will tell of it on average, in bits: the mutual information of a binary
/// symmetric channel, H(seen) - H(error) (Cover & Thomas, Elements of Information Theory, 7.1.4).
[[nodiscard]] inline double expected_bits(double chance, double error) {
  double const seen = chance * (1.0 - error) + (1.0 - chance) * error;
  return std::max(0.0, entropy_bits(seen) - entropy_bits(error));
}

/// What a chance becomes after `passed` where cars come and go: the prediction of a Markov chain of two states that
/// forgets with the time `memory` and rests at `rest` (Meyer-Delius, Beinhofer & Burgard 2012, in continuous time).
[[nodiscard]] inline double aged(double chance, double rest, base::Duration passed, base::Duration memory) {
  double const kept = std::exp(-std::max(0.0, base::to_seconds(passed)) / base::to_seconds(memory));
  return rest + (chance - rest) * kept;
}

/// The chance that what is off by a normal error of `sigma` is off by less than `reach`, to either side.
[[nodiscard]] inline double chance_within(double reach, double sigma) {
  if (sigma <= 0.0) return reach > 0.0 ? 1.0 : 0.0;
  return std::max(0.0, std::erf(reach / (sigma * std::sqrt(2.0))));
}

}  // namespace lapwing::explore
