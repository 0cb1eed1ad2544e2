#include "slam/readers/sonar_ring.hpp"

#include <algorithm>
#include <numbers>

#include "slam/readers/log_builder.hpp"
#include "slam/readers/text_lines.hpp"

namespace lapwing::slam {

base::Result<ScanLog> read_sonar_ring(std::string_view text) {
  constexpr std::size_t sonars = sonar_ring_columns - 1;
  constexpr double step = 2.0 * std::numbers::pi / sonars;
  constexpr double lines_per_s = 9.0;
  constexpr float no_return_m = 4.99F;
  LogBuilder builder;
  Sensor sensor{.bearings_rad = {}, .no_return_m = no_return_m};
  // Ascending: the line's order turned round, from just behind the back on its right.
  for (std::size_t i = 0; i < sonars; ++i)
    sensor.bearings_rad.push_back(static_cast<float>((static_cast<double>(i) - 11.0) * step));
  auto const number = builder.sensor(sensor);
  Lines lines(text);
  std::size_t count = 0;
  while (auto const line = lines.next()) {
    if (line->empty() || line->starts_with('#')) continue;
    Words words(*line, ',');
    std::vector<float> ranges(sonars);
    auto is_whole = true;
    for (std::size_t i = 0; i < sonars; ++i) {
      auto const range = words.finite();
      is_whole = is_whole && range.has_value();
      // Sonar i looks i steps to the right of the front, which is the 12th of those that ascend.
      ranges[(sonars + 11 - i) % sonars] = static_cast<float>(range.value_or(0.0));
    }
    if (!is_whole && !lines.is_whole()) continue;
    if (!is_whole) return fail_at(lines.number(), fmt::format("expected {} ranges", sonars));
    Scan scan{.time = LogTime(static_cast<double>(count++) / lines_per_s),
              .sensor = *number,
              .odometry = {},
              .ranges_m = std::move(ranges)};
    if (!builder.add(std::move(scan)))
      return fail_at(lines.number(), fmt::format("more than {} readings", LogBuilder::most_readings),
                     "cut the log into parts");
  }
  if (builder.is_empty()) return base::fail(base::ErrorKind::invalid_input, "no line of ranges");
  return std::move(builder).finish();
}

}  // namespace lapwing::slam
