#include "dryrun/words.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace lapwing::dryrun {

std::string clock_text(base::Duration time) {
  auto const seconds = std::llround(base::to_seconds(time));
  auto const minutes = seconds / 60;
  if (minutes < 60) return fmt::format("{}:{:02}", minutes, seconds % 60);
  return fmt::format("{}:{:02}:{:02}", minutes / 60, minutes % 60, seconds % 60);
}

std::string length_text(double metres) {
  if (metres < 9.995) return fmt::format("{:.2f} m", metres);
  if (metres < 99.95) return fmt::format("{:.1f} m", metres);
  if (metres < 9999.5) return fmt::format("{:.0f} m", metres);
  return fmt::format("{:.2f} km", metres / 1000.0);
}

std::string number_text(double value, int decimals) {
  auto text = fmt::format("{:.{}f}", value, decimals);
  bool const is_zero = text.find_first_not_of("-0.") == std::string::npos;
  return is_zero && text.front() == '-' ? text.substr(1) : text;
}

std::string place_text(geo::Ned place) {
  double const north = std::round(place.north);
  double const east = std::round(place.east);
  std::string text;
  if (north != 0.0) text = fmt::format("{:.0f} m {}", std::abs(north), north < 0.0 ? "south" : "north");
  if (north != 0.0 && east != 0.0) text += " and ";
  if (east != 0.0) text += fmt::format("{:.0f} m {}", std::abs(east), east < 0.0 ? "west" : "east");
  return text.empty() ? "at home" : text + " of home";
}

std::string wind_text(geo::Ned air_m_s, double gust_m_s) {
  double const speed = std::hypot(air_m_s.north, air_m_s.east);
  auto const from = std::llround(std::atan2(-air_m_s.east, -air_m_s.north) * 180.0 / std::numbers::pi + 360.0) % 360;
  auto text = speed > 0.0 ? fmt::format("wind {:.1f} m/s from {}°", speed, from) : std::string("no wind");
  if (gust_m_s > 0.0) text += fmt::format(", gusts {:.1f} m/s", gust_m_s);
  return text;
}

std::string difference_text(double reference, double value) {
  if (reference <= 0.0) return {};
  return fmt::format("{:+.0f} %", 100.0 * (value - reference) / reference);
}

}  // namespace lapwing::dryrun
