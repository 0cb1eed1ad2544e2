#pragma once

#include <optional>
#include <vector>

#include "firmware/frames/codec.hpp"
#include "firmware/program.hpp"
#include "firmware/testing/wheel_body.hpp"

namespace lapwing::firmware::testing {

/// A body of the office robot's size: 24 cm between the wheels, 5000 pulses a metre, five sonars.
[[nodiscard]] Description office_robot();

/// A body with the program on it, and a host that says what the test says. All in simulated time, 10 ms a step.
class Rig {
 public:
  explicit Rig(Description const& description = office_robot(), Tuning const& tuning = {});

  void tell(FromHost const& record);
  void run(Time span);
  /// False when `span` passed first.
  template <class Condition>
  bool run_until(Condition const& condition, Time span) {
    for (Time const end = now_ + span; now_ < end;) {
      if (condition()) return true;
      run(step);
    }
    return condition();
  }

  static constexpr Time step = std::chrono::milliseconds(10);

  WheelBody body;
  /// Says `Alive` five times a second.
  bool is_host_alive = true;

  [[nodiscard]] Time now() const { return now_; }
  [[nodiscard]] Program const& program() const { return program_; }
  [[nodiscard]] std::vector<Readings> const& readings() const { return readings_; }
  [[nodiscard]] Readings const& last() const { return readings_.back(); }
  [[nodiscard]] std::vector<CommandNumber> const& completed() const { return completed_; }
  [[nodiscard]] std::vector<Hello> const& hellos() const { return hellos_; }
  [[nodiscard]] std::vector<LaserPiece> const& pieces() const { return pieces_; }
  [[nodiscard]] std::vector<Log> const& logs() const { return logs_; }
  [[nodiscard]] int count(LogCode code) const;
  [[nodiscard]] FrameReader::Counters const& counters() const { return reader_.counters(); }

 private:
  void listen();

  Program program_;
  Time now_{};
  std::uint8_t sequence_ = 0;
  std::optional<Time> alive_;
  FrameReader reader_;
  std::vector<Readings> readings_;
  std::vector<CommandNumber> completed_;
  std::vector<Hello> hellos_;
  std::vector<LaserPiece> pieces_;
  std::vector<Log> logs_;
};

}  // namespace lapwing::firmware::testing
