#include "station/fields/field_visitor.hpp"

#include <cmath>

namespace lapwing::station::internal {

double rounded(double value, Unit const& unit) {
  // Each way exact where the result is: 0.1 is no factor to multiply with.
  double const scale = std::pow(10.0, std::abs(unit.decimals));
  double const near = unit.decimals < 0 ? std::round(value / scale) * scale : std::round(value * scale) / scale;
  return near + 0.0;  // no negative zero
}

}  // namespace lapwing::station::internal
