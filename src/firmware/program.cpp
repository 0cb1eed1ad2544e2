#include "firmware/program.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <variant>

#include "firmware/frames/codec.hpp"

namespace lapwing::firmware {

namespace {

/// What is read in one go; the rest waits for the next turn, so that a flood cannot hold up the wheels.
std::size_t constexpr most_bytes_a_step = 512;

std::int16_t permille(float fraction) {
  return static_cast<std::int16_t>(std::lround(fraction * 1000));
}

void add_to(Vector3& sum, Vector3 const& more) {
  sum.x += more.x;
  sum.y += more.y;
  sum.z += more.z;
}

Vector3 mean(Vector3 const& sum, int count) {
  auto const n = static_cast<float>(count);
  return {.x = sum.x / n, .y = sum.y / n, .z = sum.z / n};
}

}  // namespace

Program::Program(Board& board, Description const& description, Tuning const& tuning)
    : board_(board), description_(description), tuning_(tuning), carrier_(description, tuning) {
  out_.log(Time{0}, LogCode::started);
}

void Program::step(Time now) {
  listen(now);
  sense(now);
  if (!controlled_ || now - *controlled_ >= tuning_.control_period) {
    controlled_ = now;
    carrier_.control(now, pulses_, out_);
  }
  // In every step, since a kill may have come in any.
  auto const voltages = carrier_.voltages();
  board_.drive_wheels(voltages.left, voltages.right);
  speak(now);
}

// ---- from the host ----

void Program::listen(Time now) {
  std::array<std::uint8_t, 64> bytes{};
  for (std::size_t taken = 0; taken < most_bytes_a_step;) {
    auto const count = std::min(board_.receive(bytes), bytes.size());
    if (count == 0) break;
    taken += count;
    for (auto const byte : std::span(bytes).first(count))
      if (reader_.push(byte)) take(now, reader_.packet());
  }
  complain(now);
}

void Program::take(Time now, Packet const& packet) {
  auto const record = read_from_host(packet);
  if (!record) return out_.log(now, LogCode::unknown_frame, packet.type);
  if (std::holds_alternative<Hail>(*record)) is_hello_due_ = true;
  carrier_.take(now, *record, out_);
}

void Program::complain(Time now) {
  auto const& counters = reader_.counters();
  if (counters.damaged != told_.damaged)
    out_.log(now, LogCode::damaged_frames, static_cast<std::int32_t>(counters.damaged));
  if (counters.other_version != told_.other_version) out_.log(now, LogCode::other_version, reader_.other_version());
  told_ = counters;
}

// ---- from the sensors ----

void Program::sense(Time now) {
  pulses_ = board_.pulses();
  if (auto const sample = board_.imu()) {
    carrier_.feel(now, *sample);
    add(*sample);
  }
  carrier_.hear(board_.echoes_us());
  if (auto const scan = board_.laser()) {
    // What was not sent of the one before is late now.
    scan_ = scan;
    scan_sent_ = 0;
    carrier_.see(*scan);
  }
}

void Program::add(ImuSample const& sample) {
  imu_.newest = sample.orientation;
  add_to(imu_.rate_rad_s, sample.rate_rad_s);
  add_to(imu_.acceleration_m_s2, sample.acceleration_m_s2);
  ++imu_.count;
}

// ---- to the host ----

bool Program::send(FromBoard const& record) {
  if (!board_.send(write(record, sequence_).view())) return false;
  ++sequence_;
  return true;
}

void Program::speak(Time now) {
  if (is_hello_due_ && send(Hello{.time = now, .description = description_})) is_hello_due_ = false;
  bool const is_kill_news = carrier_.is_killed() != was_killed_;
  if (is_kill_news || !told_readings_ || now - *told_readings_ >= tuning_.readings_period) {
    if (send(readings(now))) {
      was_killed_ = carrier_.is_killed();
      imu_ = {};
      // Of the time when they were due, so that the rate holds when steps come a little late.
      bool const keeps_time = told_readings_ && !is_kill_news && now - *told_readings_ < 2 * tuning_.readings_period;
      told_readings_ = keeps_time ? *told_readings_ + tuning_.readings_period : now;
    }
  }
  while (!out_.completed.empty() && send(out_.completed.front())) out_.completed.pop();
  while (!out_.logs.empty() && send(out_.logs.front())) out_.logs.pop();
  send_scan();
}

Readings Program::readings(Time now) {
  Readings readings;
  readings.time = now;
  readings.left_pulses = pulses_.left;
  readings.right_pulses = pulses_.right;
  if (imu_.count > 0)
    readings.imu = Imu{.orientation = imu_.newest,
                       .rate_rad_s = mean(imu_.rate_rad_s, imu_.count),
                       .acceleration_m_s2 = mean(imu_.acceleration_m_s2, imu_.count)};
  auto const echoes = board_.echoes_us();
  auto const sonars = std::min(echoes.size(), static_cast<std::size_t>(description_.sonar_count));
  readings.sonar_count = static_cast<std::uint8_t>(sonars);
  std::copy_n(echoes.begin(), sonars, readings.echoes_us.begin());
  auto const battery = board_.battery();
  readings.battery_mv = battery.mv;
  readings.battery_percent = battery.percent;
  bool const is_low = battery.percent && *battery.percent <= tuning_.battery_low_percent;
  if (is_low && !is_battery_low_) out_.log(now, LogCode::battery_low, *battery.percent);
  is_battery_low_ = is_low;
  readings.flags = carrier_.flags(now);
  readings.command = carrier_.command();
  readings.completed = carrier_.completed();
  auto const voltages = carrier_.voltages();
  readings.left_output_permille = permille(voltages.left);
  readings.right_output_permille = permille(voltages.right);
  return readings;
}

void Program::send_scan() {
  if (!scan_) return;
  auto const& laser = description_.laser;
  auto const beams = std::min(scan_->ranges_mm.size(), static_cast<std::size_t>(laser.beams));
  while (scan_sent_ < beams) {
    LaserPiece piece{.time = scan_->time,
                     .first_angle_rad = laser.first_angle_rad,
                     .step_rad = laser.step_rad,
                     .beams = static_cast<std::uint16_t>(beams),
                     .begin = scan_sent_,
                     .count = static_cast<std::uint8_t>(std::min(beams - scan_sent_, most_piece_ranges))};
    std::copy_n(scan_->ranges_mm.begin() + scan_sent_, piece.count, piece.ranges_mm.begin());
    if (!send(piece)) return;
    scan_sent_ = static_cast<std::uint16_t>(scan_sent_ + piece.count);
  }
  scan_.reset();
}

}  // namespace lapwing::firmware
