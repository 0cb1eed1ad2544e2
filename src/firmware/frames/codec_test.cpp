#include "firmware/frames/codec.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::firmware {
namespace {

/// As it arrives at the other end.
template <class Record>
auto over_the_line(Record const& record, auto const& read) {
  FrameReader reader;
  auto const frame = write(record, 3);
  bool is_whole = false;
  for (auto const byte : frame.view()) is_whole = reader.push(byte);
  EXPECT_TRUE(is_whole);
  return read(reader.packet());
}

std::optional<FromBoard> from_board(FromBoard const& record) {
  return over_the_line(record, read_from_board);
}
std::optional<FromHost> from_host(FromHost const& record) {
  return over_the_line(record, read_from_host);
}

Hello example_hello() {
  Hello hello;
  hello.time = Time(1'234'567);
  auto& body = hello.description;
  body = {.wheel_base_m = 0.24F,
          .pulses_per_m = 5'000.0F,
          .top_speed_m_s = 0.3F,
          .braking_m_s2 = 0.5F,
          .hull = {.front_m = 0.15F, .back_m = 0.12F, .half_width_m = 0.13F},
          .sonar_count = 2,
          .sonars = {},
          .laser = {.beams = 360,
                    .x_m = 0.05F,
                    .y_m = 0.0F,
                    .first_angle_rad = -3.125F,
                    .step_rad = 0.0175F,
                    .longest_m = 12.0F,
                    .scan_duration_s = 0.125F}};
  body.sonars[0] = {.x_m = 0.15F, .y_m = 0, .angle_rad = 0, .half_cone_rad = 0.25F, .longest_m = 7.5F};
  body.sonars[1] = {.x_m = 0.0F, .y_m = 0.13F, .angle_rad = 1.571F, .half_cone_rad = 0.25F, .longest_m = 5.0F};
  return hello;
}

Readings example_readings() {
  Readings readings;
  readings.time = Time(99'000'000);
  readings.left_pulses = -2'000'000'000;
  readings.right_pulses = 17;
  readings.imu = Imu{.orientation = {.w = 0.6F, .x = 0, .y = 0, .z = 0.8F},
                     .rate_rad_s = {.x = 0.001F, .y = -0.002F, .z = 1.5F},
                     .acceleration_m_s2 = {.x = 0.25F, .y = 0, .z = 9.807F}};
  readings.sonar_count = 5;
  readings.echoes_us = {100, no_echo_us, 65535, 4, 5};
  readings.battery_mv = 12'100;
  readings.battery_percent = 80;
  readings.flags = bit(Flag::killed) | bit(Flag::slipping);
  readings.command = 7;
  readings.completed = 6;
  readings.left_output_permille = -1000;
  readings.right_output_permille = 250;
  return readings;
}

TEST(Codec, WhatABoardSaysArrivesAsItWas) {
  LaserPiece piece{
      .time = Time(5), .first_angle_rad = -3.0F, .step_rad = 0.0125F, .beams = 360, .begin = 300, .count = 60};
  piece.ranges_mm[59] = 4321;
  for (FromBoard const& record :
       {FromBoard(example_hello()), FromBoard(example_readings()), FromBoard(Readings{}), FromBoard(piece),
        FromBoard(Completed{.number = 65535}), FromBoard(Log{.time = Time(9), .code = LogCode::too_near, .value = -1})})
    EXPECT_EQ(from_board(record), record) << record.index();
}

TEST(Codec, WhatAHostSaysArrivesAsItWas) {
  for (FromHost const& record :
       {FromHost(Hail{}), FromHost(Drive{.number = 1, .speed_m_s = -0.25F, .by = Drive::By::rate, .turn = -0.5F}),
        FromHost(Drive{.number = 2, .speed_m_s = 0.3F, .by = Drive::By::heading, .turn = 3.125F}),
        FromHost(Turn{.number = 9, .heading_rad = 6.25F}), FromHost(Stop{.number = 3}), FromHost(Kill{}),
        FromHost(Release{}), FromHost(Alive{})})
    EXPECT_EQ(from_host(record), record) << record.index();
}

TEST(Codec, AFullDescriptionAndAFullPieceFitIntoAFrame) {
  Hello hello = example_hello();
  hello.description.sonar_count = most_sonars;
  EXPECT_TRUE(from_board(hello));
  EXPECT_TRUE(from_board(LaserPiece{.step_rad = 0.01F, .beams = most_beams, .begin = 100, .count = most_piece_ranges}));
}

TEST(Codec, RefusesEveryOtherLength) {
  for (FromBoard const& record : {FromBoard(example_hello()), FromBoard(example_readings()),
                                  FromBoard(Completed{.number = 1}), FromBoard(Log{})}) {
    FrameReader reader;
    for (auto const byte : write(record, 0).view()) (void)reader.push(byte);
    auto const packet = reader.packet();
    std::vector<std::uint8_t> payload(packet.payload.begin(), packet.payload.end());
    payload.push_back(0);
    EXPECT_FALSE(read_from_board({.type = packet.type, .payload = payload}));
    for (std::size_t size = 0; size + 1 < payload.size(); ++size)
      EXPECT_FALSE(read_from_board({.type = packet.type, .payload = std::span(payload).first(size)})) << size;
  }
}

TEST(Codec, RefusesWhatCannotBe) {
  auto hello = example_hello();
  hello.description.wheel_base_m = 0;
  EXPECT_FALSE(from_board(hello));
  auto bent = example_readings();
  bent.imu->orientation.z = 0;
  EXPECT_FALSE(from_board(bent));
  EXPECT_FALSE(from_board(LaserPiece{.beams = 10, .begin = 5, .count = 6}));
  EXPECT_FALSE(from_board(LaserPiece{.beams = 10, .begin = 0, .count = 0}));
  EXPECT_FALSE(from_board(Completed{.number = 0}));
  EXPECT_FALSE(from_host(Drive{.number = 0}));
  EXPECT_FALSE(from_host(Turn{.number = 1, .heading_rad = 13}));
  EXPECT_FALSE(from_host(Drive{.number = 1, .speed_m_s = 11}));
}

TEST(Codec, WhatIsNoNumberGoesOverTheLineAsZeroAndWhatIsTooLargeAsTheLargest) {
  auto const none = from_host(Drive{.number = 1, .speed_m_s = std::numeric_limits<float>::quiet_NaN()});
  ASSERT_TRUE(none);
  EXPECT_EQ(std::get<Drive>(*none).speed_m_s, 0.0F);
  auto readings = example_readings();
  readings.imu->acceleration_m_s2.x = 1e9F;
  auto const large = from_board(readings);
  ASSERT_TRUE(large);
  EXPECT_FLOAT_EQ(std::get<Readings>(*large).imu->acceleration_m_s2.x, 32.767F);
}

TEST(Codec, TakesNothingFromTheWrongSide) {
  FrameReader reader;
  for (auto const byte : write(FromHost(Kill{}), 0).view()) (void)reader.push(byte);
  EXPECT_FALSE(read_from_board(reader.packet()));
  EXPECT_TRUE(read_from_host(reader.packet()));
}

}  // namespace
}  // namespace lapwing::firmware
