#include "parameters/comparison.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

namespace lapwing::parameters {

namespace {

/// ArduPilot's first, then PX4's.
constexpr std::array of_one_vehicle{
    "SYSID_THISMAV", "MAV_SYSID",
    // calibration
    "INS_ACC*_ID", "INS_ACC*OFFS_?", "INS_ACC*SCAL_?", "INS_ACC*_CALTEMP", "INS_GYR*_ID", "INS_GYR*OFFS_?",
    "INS_GYR*_CALTEMP", "INS_TCAL*", "AHRS_TRIM_?", "COMPASS_OFS*", "COMPASS_DIA*", "COMPASS_ODI*", "COMPASS_MOT*",
    "COMPASS_SCALE*", "COMPASS_DEV_ID*", "COMPASS_PRIO*_ID", "BARO*_GND_PRESS", "BARO*_DEVID", "ARSPD*_OFFSET",
    "ARSPD*_DEVID",
    // counters, and what was uploaded
    "STAT_*", "SYS_NUM_RESETS", "MIS_TOTAL", "FENCE_TOTAL", "RALLY_TOTAL", "BRD_SERIAL_NUM", "FORMAT_VERSION",
    // PX4
    "MAV_SYS_ID", "CAL_*", "TC_*", "LND_FLIGHT_T_*", "COM_FLIGHT_UUID", "SYS_PARAM_VER", "_HASH_CHECK"};

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

}  // namespace

std::vector<Difference> differences(std::span<Parameter const> first, std::span<Parameter const> second) {
  std::map<std::string_view, std::pair<Parameter const*, Parameter const*>> by_name;
  for (auto const& parameter : first) by_name[parameter.name].first = &parameter;
  for (auto const& parameter : second) by_name[parameter.name].second = &parameter;
  std::vector<Difference> found;
  for (auto const& [name, both] : by_name) {
    auto const [a, b] = both;
    if (a && b && mavlink::same_value(*a, *b)) continue;
    found.push_back({std::string(name), a ? std::optional(*a) : std::nullopt, b ? std::optional(*b) : std::nullopt});
  }
  return found;
}

bool belongs_to_one_vehicle(std::string_view name) {
  return std::ranges::any_of(of_one_vehicle, [name](std::string_view pattern) { return fits(name, pattern); });
}

/// Goes back to the last star when letters do not fit: linear for one star, never worse than the product.
bool fits(std::string_view name, std::string_view pattern) {
  std::size_t n = 0;
  std::size_t p = 0;
  std::size_t star = std::string_view::npos;
  std::size_t star_reached = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      star_reached = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || lower(pattern[p]) == lower(name[n]))) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++star_reached;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

bool fits_any(std::string_view name, std::span<std::string const> patterns) {
  return patterns.empty() || std::ranges::any_of(patterns, [name](auto const& pattern) { return fits(name, pattern); });
}

}  // namespace lapwing::parameters
