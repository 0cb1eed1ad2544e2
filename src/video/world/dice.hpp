#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace lapwing::video {

/// Chance of one thing alone, by what it is named with: the same numbers give the same values, whatever was drawn
/// before (splitmix64, Steele, Lea & Flood 2014).
class Dice {
 public:
  explicit Dice(std::uint64_t seed, std::uint64_t what = 0, std::uint64_t a = 0, std::uint64_t b = 0)
      : state_(mixed(mixed(mixed(mixed(seed) ^ what) ^ a) ^ b)) {}

  [[nodiscard]] std::uint64_t bits() { return mixed(state_++); }
  /// In (0, 1).
  [[nodiscard]] double uniform() { return (static_cast<double>(bits() >> 11U) + 0.5) * 0x1p-53; }
  [[nodiscard]] double uniform(double least, double most) { return least + (most - least) * uniform(); }
  [[nodiscard]] bool happens(double probability) { return uniform() < probability; }
  /// Mean 0, standard deviation 1 (Box & Muller 1958).
  [[nodiscard]] double gaussian() {
    double const radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  [[nodiscard]] static std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
  }

  std::uint64_t state_;
};

}  // namespace lapwing::video
