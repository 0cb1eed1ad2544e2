#include "robot/watch/self_report.hpp"

#include <algorithm>

#include "robot/watch/codes.hpp"

namespace lapwing::robot {

namespace {

using firmware::Flag;

/// Of the frames of a while, so many in a hundred: a line that is worse than this is worth a look.
std::uint32_t constexpr damaged_percent = 5;
std::uint32_t constexpr enough_frames = 20;
std::uint8_t constexpr low_percent = 15;

bool is_line_damaged(firmware::FrameReader::Counters const& before, firmware::FrameReader::Counters const& now) {
  auto const damaged = now.damaged - before.damaged;
  auto const all = damaged + now.frames - before.frames;
  return all >= enough_frames && damaged * 100 > all * damaged_percent;
}

}  // namespace

std::uint16_t carrier_code(CarrierClient::Status const& status, firmware::FrameReader::Counters const& frames_before) {
  if (!status.is_here)
    return status.frames.other_version > frames_before.other_version ? code::board_version : code::board_away;
  if (!status.readings) return code::none;
  auto const& readings = *status.readings;
  if (readings.has(Flag::left_wheel_dead)) return code::left_wheel_dead;
  if (readings.has(Flag::right_wheel_dead)) return code::right_wheel_dead;
  if (readings.has(Flag::watchdog)) return code::board_watchdog;
  if (readings.battery_percent && *readings.battery_percent <= low_percent) return code::battery_low;
  if (is_line_damaged(frames_before, status.frames)) return code::line_damaged;
  if (readings.has(Flag::killed)) return code::killed;
  return readings.has(Flag::too_near) ? code::too_near : code::none;
}

std::uint16_t sensors_code(Sensed::Faults const& faults) {
  if (faults.imu == SensorFault::dropouts) return code::imu_silent;
  if (faults.imu != SensorFault::none) return code::imu_faulty;
  if (faults.encoders == SensorFault::jumping) return code::pulses_jump;
  auto const has = [&](SensorFault fault) { return std::ranges::find(faults.sonars, fault) != faults.sonars.end(); };
  if (has(SensorFault::stuck)) return code::sonar_stuck;
  if (has(SensorFault::jumping)) return code::sonar_jumping;
  if (faults.is_slipping) return code::wheels_slip;
  return has(SensorFault::dropouts) ? code::sonar_dropouts : code::none;
}

}  // namespace lapwing::robot
