#include "slam/readers/four_rangers.hpp"

#include <array>
#include <numbers>

#include "slam/readers/log_builder.hpp"
#include "slam/readers/text_lines.hpp"

namespace lapwing::slam {
namespace {

constexpr float half_turn = std::numbers::pi_v<float>;
/// Right, front, left, back: as they stand in the line, and ascending.
constexpr std::array bearings{-0.5F * half_turn, 0.0F, 0.5F * half_turn, half_turn};
/// The VL53L1x sees about so far; what it tells beyond is of floors and of light.
constexpr float most_range_m = 2.5F;

}  // namespace

base::Result<ScanLog> read_four_rangers(std::string_view text) {
  LogBuilder builder;
  auto const sensor = builder.sensor({.bearings_rad = {bearings.begin(), bearings.end()}, .no_return_m = most_range_m});
  Lines lines(text);
  while (auto const line = lines.next()) {
    if (line->empty() || line->starts_with('#')) continue;
    Words words(*line);
    std::array<double, four_rangers_columns> values{};
    auto is_whole = true;
    for (auto& value : values) {
      auto const number = words.finite();
      is_whole = is_whole && number.has_value();
      value = number.value_or(0.0);
    }
    if (!is_whole && !lines.is_whole()) continue;
    if (!is_whole) return fail_at(lines.number(), "expected the eight numbers t x y yaw right front left back");
    Scan scan{
        .time = LogTime(values[0]), .sensor = *sensor, .odometry = {values[1], values[2], values[3]}, .ranges_m = {}};
    for (std::size_t i = 4; i < values.size(); ++i) scan.ranges_m.push_back(static_cast<float>(values[i]));
    if (!builder.add(std::move(scan)))
      return fail_at(lines.number(), fmt::format("more than {} readings", LogBuilder::most_readings),
                     "cut the log into parts");
  }
  if (builder.is_empty()) return base::fail(base::ErrorKind::invalid_input, "no line of eight numbers");
  return std::move(builder).finish();
}

}  // namespace lapwing::slam
