#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string_view>

namespace lapwing::sim::building {

/// Chance of one thing alone: each sensor, wheel, door and person has its own, named, so that more of one changes
/// nothing of another. The same seed, name and number give the same values, whatever the standard library.
class Noise {
 public:
  Noise(std::uint64_t seed, std::string_view name, std::uint64_t number = 0) : bits_(mixed(seed, name, number)) {}

  [[nodiscard]] std::uint64_t bits() { return bits_(); }
  /// In [0, 1).
  [[nodiscard]] double uniform() { return static_cast<double>(bits_() >> 11U) * 0x1.0p-53; }
  [[nodiscard]] double uniform(double least, double most) { return least + (most - least) * uniform(); }
  [[nodiscard]] bool happens(double probability) { return uniform() < probability; }
  /// Mean 0, standard deviation 1 (Box & Muller 1958; one of the two, so that no state is left over).
  [[nodiscard]] double gaussian() {
    double const radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  /// FNV-1a over the name, and the finaliser of splitmix64, so that neighbouring seeds have nothing in common.
  static std::uint64_t mixed(std::uint64_t seed, std::string_view name, std::uint64_t number) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (char const letter : name) hash = (hash ^ static_cast<std::uint8_t>(letter)) * 0x100000001b3U;
    for (auto const more : {seed, number}) {
      hash += more + 0x9e3779b97f4a7c15U;
      hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9U;
      hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111ebU;
      hash ^= hash >> 31U;
    }
    return hash;
  }

  std::mt19937_64 bits_;
};

}  // namespace lapwing::sim::building
