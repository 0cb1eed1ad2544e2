#pragma once

#include <vector>

#include "firmware/frames/codec.hpp"
#include "sim/building/building.hpp"

namespace lapwing::sim::building::testing {

/// The host's end of a robot's line, as far as tests need it.
class HostEnd {
 public:
  explicit HostEnd(Robot& robot) : robot_(robot) {}

  void say(firmware::FromHost const& record) {
    auto const frame = firmware::write(record, sequence_++);
    robot_.to_board(frame.view());
  }
  /// Drives on with one command, said often enough for the watchdog.
  void drive(float speed_m_s, float heading_rad) {
    say(firmware::Drive{
        .number = ++number_, .speed_m_s = speed_m_s, .by = firmware::Drive::By::heading, .turn = heading_rad});
  }
  void listen() {
    auto const bytes = robot_.from_board();
    all.insert(all.end(), bytes.begin(), bytes.end());
    for (auto const byte : bytes) {
      if (!reader_.push(byte)) continue;
      if (auto const record = firmware::read_from_board(reader_.packet())) take(*record);
    }
  }

  std::vector<std::uint8_t> all;
  std::optional<firmware::Hello> hello;
  std::optional<firmware::Readings> readings;
  std::vector<firmware::LogCode> logs;
  int pieces = 0;
  int readings_count = 0;

 private:
  void take(firmware::FromBoard const& record) {
    if (auto const* said = std::get_if<firmware::Hello>(&record)) hello = *said;
    if (auto const* said = std::get_if<firmware::Readings>(&record)) {
      readings = *said;
      ++readings_count;
    }
    if (auto const* said = std::get_if<firmware::Log>(&record)) logs.push_back(said->code);
    if (std::holds_alternative<firmware::LaserPiece>(record)) ++pieces;
  }

  Robot& robot_;
  firmware::FrameReader reader_;
  std::uint8_t sequence_ = 0;
  firmware::CommandNumber number_ = 0;
};

/// Lets time pass; the host says that it is there.
inline void pass(Building& building, HostEnd& host, double seconds) {
  double const until_s = building.time_s() + seconds - Building::step_s / 2.0;
  double next_alive_s = building.time_s();
  while (building.time_s() < until_s) {
    if (building.time_s() >= next_alive_s) {
      host.say(firmware::Alive{});
      next_alive_s += 0.2;
    }
    building.step();
    host.listen();
  }
}

}  // namespace lapwing::sim::building::testing
