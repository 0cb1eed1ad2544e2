#pragma once

#include <cstdint>
#include <random>

#include "geo/position.hpp"

namespace lapwing::sim {

/// Wind at one vehicle: a steady mean with seeded gusts round it (a first-order Gauss-Markov process, three seconds
/// long).
class Gusts {
 public:
  /// `mean_m_s` is where the air goes, not where it comes from; `deviation_m_s` is the standard deviation of each
  /// component.
  Gusts(geo::Ned mean_m_s, double deviation_m_s, std::uint64_t seed)
      : mean_(mean_m_s), deviation_m_s_(deviation_m_s), random_(seed) {}

  /// The wind `dt_s` later.
  geo::Ned step(double dt_s);

 private:
  geo::Ned mean_;
  double deviation_m_s_;
  geo::Ned gust_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace lapwing::sim
