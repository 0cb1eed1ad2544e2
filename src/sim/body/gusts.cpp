#include "sim/body/gusts.hpp"

#include <cmath>

namespace lapwing::sim {

geo::Ned Gusts::step(double dt_s) {
  constexpr double correlation_time_s = 3.0;
  if (deviation_m_s_ <= 0.0) return mean_;
  double const keep = std::exp(-dt_s / correlation_time_s);
  double const fresh = deviation_m_s_ * std::sqrt(1.0 - keep * keep);
  gust_.north = keep * gust_.north + fresh * normal_(random_);
  gust_.east = keep * gust_.east + fresh * normal_(random_);
  return {mean_.north + gust_.north, mean_.east + gust_.east, 0.0};
}

}  // namespace lapwing::sim
