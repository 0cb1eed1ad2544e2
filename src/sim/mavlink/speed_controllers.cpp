#include "sim/mavlink/speed_controllers.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "mavlink/wire/raw_message.hpp"

namespace lapwing::sim {

namespace {

std::uint16_t hundredths(double value) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value * 100.0, 0.0, 65535.0)));
}

/// The four numbers of one field, at their place in the message; MAVLink and this machine agree on little endian.
template <class T>
void put(mavlink::Frame& frame, std::size_t offset, std::array<T, 4> const& values) {
  std::memcpy(frame.payload.data() + offset, values.data(), sizeof values);
}

}  // namespace

std::optional<mavlink::Frame> speed_controller_report(SpeedControllers const& told, mavlink::Address self) {
  constexpr std::uint8_t warm_c = 32;
  constexpr double full_turns_per_minute = 9000.0;
  auto frame = mavlink::raw_message("ESC_TELEMETRY_1_TO_4", {}, self, {});
  if (!frame) return std::nullopt;
  double all = 0.0;
  for (auto const& throttle : told.throttle) all += throttle.value_or(0.0);
  std::array<std::uint16_t, 4> voltage{};
  std::array<std::uint16_t, 4> current{};
  std::array<std::uint16_t, 4> turns{};
  std::array<std::uint16_t, 4> updates{};
  std::array<std::uint8_t, 4> temperature{};
  for (std::size_t i = 0; i < 4; ++i) {
    auto const throttle = told.throttle[i];
    if (!throttle) continue;
    voltage[i] = hundredths(told.voltage_v);
    current[i] = all > 0.0 ? hundredths(told.current_a * *throttle / all) : std::uint16_t{0};
    turns[i] = static_cast<std::uint16_t>(std::lround(full_turns_per_minute * std::clamp(*throttle, 0.0, 1.0)));
    updates[i] = told.updates;
    temperature[i] = warm_c;
  }
  put(*frame, 0, voltage);
  put(*frame, 8, current);
  put(*frame, 24, turns);
  put(*frame, 32, updates);
  put(*frame, 40, temperature);
  return *frame;
}

}  // namespace lapwing::sim
