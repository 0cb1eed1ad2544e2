#include "slam/readers/any_log.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

constexpr float quarter_turn = 1.5707963F;

std::string message(std::string_view text) {
  auto const log = read_log(text);
  return log ? "" : log.error().message;
}

std::string joined(std::string const& head, std::string const& number, int times) {
  auto text = head;
  for (int i = 0; i < times; ++i) text += "," + number;
  return text + "\n";
}

/// Drone 2, its third frame, 0.1 m on from the node; every depth a metre.
std::string swarm_line(std::string const& drone) {
  return joined(drone + ",0,2,1,2,0.5,0,0,0,nan,nan,nan,0.1,0,0.25", "1.0", 32);
}

TEST(AnyLog, ReadsFourRangersOfADrone) {
  auto const log = read_log("# t x y yaw\n2.5 1 2 0.5 0.7 0.6 1.4 2.8\n");
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->scans.size(), 1U);
  EXPECT_EQ(log->scans[0].time, LogTime(2.5));
  EXPECT_EQ(log->scans[0].odometry, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_EQ(log->scans[0].ranges_m, (std::vector<float>{0.7F, 0.6F, 1.4F, 2.8F}));
  EXPECT_FLOAT_EQ(log->sensors[0].bearings_rad[0], -quarter_turn);
  EXPECT_FLOAT_EQ(log->sensors[0].bearings_rad[3], 2 * quarter_turn);
}

TEST(AnyLog, ReadsCamerasThatTellDepthsAlongTheirAxes) {
  auto const log = read_log(swarm_line("2") + swarm_line("2") + swarm_line("1"));
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->scans.size(), 2U) << "the drone with the most scans";
  EXPECT_NEAR(log->scans[0].odometry.x, 1.1, 1e-9);
  EXPECT_NEAR(log->scans[0].odometry.yaw, 0.75, 1e-9);
  auto const& bearings = log->sensors[0].bearings_rad;
  ASSERT_TRUE(std::ranges::is_sorted(bearings));
  for (std::size_t b = 0; b < bearings.size(); ++b) {
    auto const off = std::abs(std::remainder(bearings[b], quarter_turn));
    EXPECT_NEAR(log->scans[0].ranges_m[b], 1.0 / std::cos(off), 0.026) << bearings[b];
    EXPECT_LT(off, 0.35F);
  }
}

TEST(AnyLog, ReadsARingOfSonarsFromTheFrontClockwise) {
  std::string line = "0.5";
  for (int i = 1; i < 24; ++i) line += "," + std::to_string(1.0 + 0.1 * i);
  auto const log = read_log(line + ",Move-Forward\n");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_FALSE(log->has_odometry);
  auto const& bearings = log->sensors[0].bearings_rad;
  auto const range_at = [&](float bearing) {
    auto const found = std::ranges::find_if(bearings, [&](float b) { return std::abs(b - bearing) < 0.01F; });
    return found == bearings.end() ? -1.0F : log->scans[0].ranges_m[static_cast<std::size_t>(found - bearings.begin())];
  };
  EXPECT_FLOAT_EQ(range_at(0.0F), 0.5F);
  EXPECT_FLOAT_EQ(range_at(-quarter_turn), 1.6F) << "the seventh looks to the right";
  EXPECT_FLOAT_EQ(range_at(quarter_turn), 2.8F);
}

TEST(AnyLog, TakesEverythingElseForALogOfCarmen) {
  EXPECT_TRUE(read_log("# comment\nFLASER 2 1 2 0 0 0 0 0 0 1 h 1\n"));
  EXPECT_EQ(message("hello\n"), "no FLASER or ROBOTLASER1 line");
  EXPECT_EQ(message(""), "no FLASER or ROBOTLASER1 line");
}

TEST(AnyLog, SaysOfAPackedLogWhatUnpacksIt) {
  using namespace std::string_view_literals;
  auto const said = [](std::string_view begins) {
    auto const log = read_log(begins);
    return log ? "read" : log.error().message + ": " + log.error().hint;
  };
  EXPECT_EQ(said("\x1F\x8B\x08\x00..."sv), "a file packed by gzip: unpack it first: 'gzip -dk LOG'");
  EXPECT_EQ(said("\xFD"
                 "7zXZ\x00..."sv),
            "a file packed by xz: unpack it first: 'xz -dk LOG'");
  EXPECT_EQ(said("BZh91AY..."sv), "a file packed by bzip2: unpack it first: 'bzip2 -dk LOG'");
  EXPECT_EQ(said("\x28\xB5\x2F\xFD..."sv), "a file packed by zstd: unpack it first: 'zstd -dk LOG'");
  EXPECT_EQ(said("PK\x03\x04..."sv), "a file packed by zip: unpack it first: 'unzip LOG'");
}

TEST(AnyLog, SaysInWhichLineWhatIsWrong) {
  EXPECT_EQ(message("1 2 3 4 5 6 7 8\n1 2 3 4 5 6 x 8\n"),
            "line 2: expected the eight numbers t x y yaw right front left back");
  EXPECT_EQ(message(swarm_line("0") + "0,0,0\n"), "line 2: expected 47 numbers");
  EXPECT_EQ(message(swarm_line("0.5")), "line 1: a drone's number must be 0 to 999");
  EXPECT_EQ(message(joined("1", "2", 23).substr(0, 47) + ",Go\n1,2\n"), "line 2: expected 24 ranges");
}

TEST(AnyLog, LeavesOutALastLineThatWasCutOff) {
  EXPECT_EQ(read_log("1 2 3 4 5 6 7 8\n1 2 3")->scans.size(), 1U);
  EXPECT_EQ(read_log(swarm_line("0") + "0,0,1,2")->scans.size(), 1U);
}

}  // namespace
}  // namespace lapwing::slam
