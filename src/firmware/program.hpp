#pragma once

#include <cstdint>
#include <optional>

#include "firmware/board.hpp"
#include "firmware/carrier/carrier.hpp"
#include "firmware/carrier/outbox.hpp"
#include "firmware/carrier/tuning.hpp"
#include "firmware/wire/frame.hpp"

namespace lapwing::firmware {

/// The whole program of a board: `step` again and again, at least once each control period.
///
/// Takes commands, runs the carrier, sends readings ten times a second and scans as they come. Three kilobytes, no
/// heap. Deterministic: what it does depends on the calls' times and what the board gives, nothing else.
class Program {
 public:
  /// `board` must outlive it.
  Program(Board& board, Description const& description, Tuning const& tuning = {});

  void step(Time now);

  [[nodiscard]] Carrier const& carrier() const { return carrier_; }

 private:
  /// Sums of what came since the last readings, so that they say means.
  struct ImuMeans {
    Quaternion newest;
    Vector3 rate_rad_s;
    Vector3 acceleration_m_s2;
    int count = 0;
  };
  void listen(Time now);
  void take(Time now, Packet const& packet);
  void complain(Time now);
  void sense(Time now);
  void add(ImuSample const& sample);
  void speak(Time now);
  [[nodiscard]] Readings readings(Time now);
  [[nodiscard]] bool send(FromBoard const& record);
  void send_scan();

  Board& board_;
  Description description_;
  Tuning tuning_;
  Carrier carrier_;
  FrameReader reader_;
  FrameReader::Counters told_;
  Outbox out_;
  std::uint8_t sequence_ = 0;

  Pulses pulses_;
  ImuMeans imu_;
  std::optional<LaserScan> scan_;
  std::uint16_t scan_sent_ = 0;
  bool is_hello_due_ = true;
  bool is_battery_low_ = false;
  bool was_killed_ = false;
  std::optional<Time> controlled_;
  std::optional<Time> told_readings_;
};

}  // namespace lapwing::firmware
