#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "firmware/board.hpp"
#include "firmware/program.hpp"
#include "sim/building/body/drive.hpp"
#include "sim/building/robot/fault.hpp"
#include "sim/building/robot/robot_settings.hpp"

namespace lapwing::sim::building {

/// Something that a robot ran into: told once, until it has been free of it for half a second.
struct Collision {
  double time_s = 0.0;
  std::uint32_t robot = 0;
  Contact contact;
};

/// A body with sensors, and the board on it that runs the firmware's program. The other end of its line is bytes.
class Robot final : public firmware::Board {
 public:
  Robot(RobotSettings const& settings, Pose const& start, std::uint64_t seed, std::uint32_t number);
  Robot(Robot const&) = delete;
  Robot& operator=(Robot const&) = delete;

  /// Moves the body on to `now_s`, measures, and lets the program take one step. Returns what it has run into newly.
  std::vector<Collision> step(double now_s, double seconds, Surroundings const& around);

  // The line, from the host's end.
  void to_board(std::span<std::uint8_t const> bytes);
  /// What the board has sent since the last call, in whole frames.
  [[nodiscard]] std::vector<std::uint8_t> from_board();

  // Faults.
  void set(Fault const& fault);
  void mend(Fault::Kind kind);
  void mend_all();
  [[nodiscard]] std::vector<Fault> const& faults() const { return faults_; }
  [[nodiscard]] Fault const* fault(Fault::Kind kind) const;
  /// The board loses its power for a moment: its program starts anew, its clock and its heading begin at zero.
  void restart_board();

  [[nodiscard]] DrivenBody& body() { return body_; }
  [[nodiscard]] DrivenBody const& body() const { return body_; }
  [[nodiscard]] RobotSettings const& settings() const { return settings_; }
  [[nodiscard]] std::uint32_t number() const { return number_; }
  [[nodiscard]] Post post() const;
  /// The voltages of now, as parts of the full one: zero when the board has cut them.
  [[nodiscard]] std::pair<double, double> voltages() const { return {left_voltage_, right_voltage_}; }

  // firmware::Board
  [[nodiscard]] firmware::Pulses pulses() override;
  [[nodiscard]] std::optional<firmware::ImuSample> imu() override;
  [[nodiscard]] std::span<std::uint16_t const> echoes_us() override;
  [[nodiscard]] std::optional<firmware::LaserScan> laser() override;
  [[nodiscard]] firmware::Battery battery() override;
  void drive_wheels(float left, float right) override;
  [[nodiscard]] std::size_t receive(std::span<std::uint8_t> into) override;
  bool send(std::span<std::uint8_t const> frame) override;

 private:
  [[nodiscard]] bool has(Fault::Kind kind, int which) const;
  void sense(double now_s, double seconds, Surroundings const& around);
  void count_pulses();
  void fire_sonar(Surroundings const& around);
  [[nodiscard]] std::vector<Collision> news_of(double now_s, std::vector<Contact> const& contacts);
  [[nodiscard]] firmware::Time board_time(double time_s) const;

  RobotSettings settings_;
  std::uint64_t seed_;
  std::uint32_t number_;
  DrivenBody body_;
  Laser laser_;
  Imu imu_;
  Noise sonar_noise_;
  std::vector<Fault> faults_;

  double now_s_ = 0.0;
  double board_began_s_ = 0.0;
  std::unique_ptr<firmware::Program> program_;  // a restart is a new one
  double left_voltage_ = 0.0;
  double right_voltage_ = 0.0;
  std::vector<std::uint8_t> to_board_;
  std::vector<std::uint8_t> from_board_;

  double imu_sensed_s_ = 0.0;
  double sonar_fires_s_ = 0.0;
  std::size_t next_sonar_ = 0;
  std::optional<firmware::ImuSample> imu_sample_;
  struct Counter {
    std::int32_t seen = 0;  ///< of the wheel
    std::int32_t told = 0;
  };
  std::array<Counter, 2> counters_{};
  std::vector<std::uint16_t> echoes_;       ///< as they were heard
  std::vector<std::uint16_t> told_echoes_;  ///< with what is broken
  Laser::Scan told_scan_;
  bool has_scan_ = false;

  struct Touch {
    Contact contact;
    double last_s = 0.0;
  };
  std::vector<Touch> touches_;
};

}  // namespace lapwing::sim::building
