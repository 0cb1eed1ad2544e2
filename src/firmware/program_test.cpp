#include "firmware/program.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "firmware/testing/rig.hpp"

namespace lapwing::firmware {
namespace {

using namespace std::chrono_literals;
using testing::office_robot;
using testing::Rig;

TEST(Program, SaysHelloAtTheStartAndWhenItIsHailed) {
  Rig rig;
  rig.run(1s);
  ASSERT_EQ(rig.hellos().size(), 1U);
  EXPECT_EQ(rig.hellos()[0].description.sonar_count, 5);
  EXPECT_EQ(rig.count(LogCode::started), 1);
  rig.tell(Hail{});
  rig.run(100ms);
  EXPECT_EQ(rig.hellos().size(), 2U);
}

TEST(Program, SendsReadingsTenTimesASecond) {
  Rig rig;
  rig.run(10s);
  EXPECT_NEAR(static_cast<double>(rig.readings().size()), 100, 1);
  EXPECT_EQ(rig.counters().missed, 0U);
  EXPECT_EQ(rig.counters().damaged, 0U);
}

TEST(Program, SaysWhatTheWheelsAndTheInertialUnitFelt) {
  Rig rig;
  rig.run(100ms);
  rig.tell(Drive{.number = 1, .speed_m_s = 0.2F, .by = Drive::By::rate, .turn = 0.5F});
  rig.run(3s);
  auto const& first = rig.readings()[rig.readings().size() - 11];
  auto const& last = rig.last();
  float const way =
      static_cast<float>(last.left_pulses - first.left_pulses + last.right_pulses - first.right_pulses) / 2 / 5'000;
  EXPECT_NEAR(way, 0.2F, 0.01F);
  ASSERT_TRUE(last.imu);
  EXPECT_NEAR(last.imu->rate_rad_s.z, 0.5F, 0.05F);
  EXPECT_EQ(last.command, 1);
  EXPECT_EQ(last.battery_percent, 90);
}

TEST(Program, SendsAScanInPieces) {
  auto body = office_robot();
  body.laser = {.beams = 250,
                .x_m = 0,
                .y_m = 0,
                .first_angle_rad = -2,
                .step_rad = 0.016F,
                .longest_m = 12,
                .scan_duration_s = 0.1F};
  Rig rig(body);
  std::vector<std::uint16_t> ranges(250);
  for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = static_cast<std::uint16_t>(2'000 + i);
  rig.body.scan_mm = ranges;
  rig.run(Rig::step);
  ASSERT_EQ(rig.pieces().size(), 3U);
  std::vector<std::uint16_t> seen;
  for (auto const& piece : rig.pieces()) {
    EXPECT_EQ(piece.begin, seen.size());
    EXPECT_EQ(piece.beams, 250);
    EXPECT_EQ(piece.time, rig.pieces()[0].time);
    seen.insert(seen.end(), piece.ranges().begin(), piece.ranges().end());
  }
  EXPECT_EQ(seen, ranges);
}

TEST(Program, KeepsWhatItHasToSayWhileTheLineIsFull) {
  Rig rig;
  rig.run(100ms);
  rig.body.is_line_full = true;
  rig.tell(Kill{});
  rig.run(1s);
  rig.tell(Release{});
  rig.run(100ms);
  rig.body.is_line_full = false;
  rig.run(200ms);
  EXPECT_EQ(rig.count(LogCode::killed), 1);
  EXPECT_EQ(rig.count(LogCode::released), 1);
  EXPECT_EQ(rig.counters().missed, 0U);
}

TEST(Program, ComplainsOfNoiseAndOfWhatItDoesNotKnow) {
  Rig rig;
  rig.run(100ms);
  for (int i = 0; i < 2'000; ++i) rig.body.to_board.push_back(static_cast<std::uint8_t>(1 + i * 37 % 255));
  rig.body.to_board.push_back(0);
  auto const unknown = write_frame({.type = 0x7F, .sequence = 0, .payload = {}});
  rig.body.to_board.insert(rig.body.to_board.end(), unknown.view().begin(), unknown.view().end());
  rig.run(200ms);
  EXPECT_GE(rig.count(LogCode::damaged_frames), 1);
  EXPECT_EQ(rig.count(LogCode::unknown_frame), 1);
  EXPECT_EQ(std::ranges::find(rig.logs(), LogCode::unknown_frame, &Log::code)->value, 0x7F);
}

TEST(Program, ANoisyLineDoesNotKeepAKillOut) {
  Rig rig;
  rig.run(100ms);
  rig.tell(Drive{.number = 1, .speed_m_s = 0.2F, .by = Drive::By::rate, .turn = 0});
  rig.run(1s);
  for (int i = 0; i < 300; ++i) rig.body.to_board.push_back(static_cast<std::uint8_t>(1 + i * 37 % 255));
  rig.body.to_board.push_back(0);
  rig.tell(Kill{});
  rig.run(Rig::step);
  EXPECT_EQ(rig.body.left_output(), 0.0F);
}

TEST(Program, TellsALowBatteryOnce) {
  Rig rig;
  rig.run(1s);
  rig.body.battery_state.percent = 12;
  rig.run(2s);
  EXPECT_EQ(rig.count(LogCode::battery_low), 1);
}

TEST(Program, DoesTheSameAgainWithTheSameTimesAndReadings) {
  auto const run = [] {
    Rig rig;
    rig.body.wall_x_m = 1.0F;
    rig.body.echo_noise_m = 0.02F;
    rig.run(100ms);
    rig.tell(Drive{.number = 1, .speed_m_s = 0.3F, .by = Drive::By::heading, .turn = 0.2F});
    rig.run(8s);
    return rig.readings();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace lapwing::firmware
