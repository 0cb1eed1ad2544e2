#pragma once

#include <string>

#include "base/time.hpp"
#include "geo/position.hpp"

/// How figures are written for people, in tables and pictures alike.
namespace lapwing::dryrun {

/// "2:05", "1:02:05".
[[nodiscard]] std::string clock_text(base::Duration time);
/// "430 m", "3.21 km".
[[nodiscard]] std::string length_text(double metres);
/// "-12.5": so many decimals, and no minus before what rounds to zero.
[[nodiscard]] std::string number_text(double value, int decimals);
/// "12 m north and 3 m west of home", "over home".
[[nodiscard]] std::string place_text(geo::Ned place);
/// "wind 6.0 m/s from 270°, gusts 2.0 m/s", "no wind".
[[nodiscard]] std::string wind_text(geo::Ned air_m_s, double gust_m_s);
/// "+4 %": how much more `value` is than `reference`; empty when that is nothing.
[[nodiscard]] std::string difference_text(double reference, double value);

}  // namespace lapwing::dryrun
