#include "slam/readers/carmen.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

std::string message(std::string_view text) {
  auto const log = read_carmen(text);
  return log ? "" : log.error().message;
}

TEST(Carmen, ReadsScansInOrderOfTimeWhateverTheirOrderInTheFile) {
  auto const log = read_carmen(
      "# a comment\n"
      "PARAM robot_frontlaser_offset 0.25\n"
      "ODOM 0 0 0 0 0 0 1.0 host 1.0\n"
      "FLASER 3 1.5 2.5 3.5 1 2 0.5 1 2 0.5 20.25 host 20.25\n"
      "FLASER 3 1.0 2.0 3.0 0 0 0 0 0 0 10.5 host 10.5\n");
  ASSERT_TRUE(log) << log.error().message;
  ASSERT_EQ(log->scans.size(), 2U);
  EXPECT_EQ(log->scans[0].time, LogTime(10.5));
  EXPECT_EQ(log->scans[1].odometry, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_EQ(log->scans[1].ranges_m, (std::vector<float>{1.5F, 2.5F, 3.5F}));
  ASSERT_EQ(log->sensors.size(), 1U);
  EXPECT_FLOAT_EQ(log->sensors[0].mount_m.x(), 0.25F);
  EXPECT_TRUE(log->has_odometry);
}

/// One scan a line, at these stamps; the first reading is its number.
ScanLog stamped(std::vector<std::string> const& stamps) {
  std::string text;
  for (std::size_t i = 0; i < stamps.size(); ++i)
    text += fmt::format("FLASER 1 {} {} 0 0 {} 0 0 {} h {}\n", i + 1, i, i, stamps[i], stamps[i]);
  return *read_carmen(text);
}

TEST(Carmen, KeepsTheOrderOfTheFileWhereStampsAreEqual) {
  auto const log = stamped({"-0.4", "-0.9", "4.29e9", "4.29e9", "4.29e9", "4.29e9", "4.29e9"});
  EXPECT_FALSE(log.has_times);
  for (std::size_t i = 0; i < log.scans.size(); ++i)
    EXPECT_EQ(log.scans[i].ranges_m[0], static_cast<float>(i + 1)) << i;
  EXPECT_EQ(log.scans[6].time, LogTime(0.6));
  EXPECT_TRUE(stamped({"1", "1", "2", "3", "4"}).has_times);
}

TEST(Carmen, GoesOnWhereTheClockBeginsAnew) {
  auto const log = stamped({"100", "101", "0", "0.5"});
  for (std::size_t i = 0; i < log.scans.size(); ++i)
    EXPECT_EQ(log.scans[i].ranges_m[0], static_cast<float>(i + 1)) << i;
  EXPECT_NEAR(log.scans[3].time.count(), 101.6, 1e-9);
}

TEST(Carmen, KnowsTheAnglesOfScannersByTheirBeams) {
  auto const bearings = [](int count) {
    std::string text = "FLASER " + std::to_string(count);
    for (int i = 0; i < count; ++i) text += " 1";
    return read_carmen(text + " 0 0 0 0 0 0 1 h 1\n")->sensors[0].bearings_rad;
  };
  constexpr float degree = 0.01745329F;
  EXPECT_NEAR(bearings(180)[0], -90 * degree, 1e-5);
  EXPECT_NEAR(bearings(180)[179], 89 * degree, 1e-5);
  EXPECT_NEAR(bearings(181)[180], 90 * degree, 1e-5);
  EXPECT_NEAR(bearings(361)[1], -89.5F * degree, 1e-5);
  EXPECT_NEAR(bearings(541)[0], -135 * degree, 1e-5);
}

TEST(Carmen, ReadsScansThatBringTheirAngles) {
  auto const log =
      read_carmen("ROBOTLASER1 0 -1.5 3.0 0.5 50.0 0.01 0 4 1 2 3 4 0 0.3 0 0 0.1 0 0 0 0 0 0 0 7.5 h 7.5\n");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_FLOAT_EQ(log->sensors[0].bearings_rad[3], 0.0F);
  EXPECT_FLOAT_EQ(log->sensors[0].no_return_m, 50.0F);
  EXPECT_NEAR(log->sensors[0].mount_m.x(), 0.2F, 1e-5);
  EXPECT_EQ(log->scans[0].time, LogTime(7.5));
}

TEST(Carmen, TakesTheLargestReadingForNoneWhereItComesAgainAndAgain) {
  std::string text;
  for (int i = 0; i < 20; ++i) text += "FLASER 4 1.0 8.1 8.1 " + std::to_string(2 + 0.1 * i) + " 0 0 0 0 0 0 1 h 1\n";
  EXPECT_LT(read_carmen(text)->sensors[0].no_return_m, 8.1F);
}

TEST(Carmen, LeavesOutALastLineThatWasCutOff) {
  auto const log = read_carmen("FLASER 2 1 2 0 0 0 0 0 0 1 h 1\nFLASER 2 1 2 0 0");
  ASSERT_TRUE(log) << log.error().message;
  EXPECT_EQ(log->scans.size(), 1U);
}

TEST(Carmen, SaysInWhichLineWhatIsWrong) {
  EXPECT_EQ(message("\nFLASER 3 1 2 x 0 0 0 0 0 0 1 h 1\n"),
            "line 2: 3 readings were announced, reading 3 is no number");
  EXPECT_EQ(message("FLASER 2.5 1\n"), "line 1: the number of readings must be 0 to 20000");
  EXPECT_EQ(message("FLASER 30000 1\n"), "line 1: the number of readings must be 0 to 20000");
  EXPECT_EQ(message("FLASER 1 1 0 0 0 0 0 nan 1 h 1\n"),
            "line 1: expected the numbers x y theta odom_x odom_y odom_theta ipc_timestamp after the readings");
  EXPECT_EQ(message("ROBOTLASER1 0 -1.5 3.0 0 50.0 0.01 0 1 1 0 0 0 0 0 0 0 0 0 0 0 0 1 h 1\n"),
            "line 1: start angle and resolution do not describe a scan of at most one turn");
  std::string many;
  for (int i = 0; i < 300; ++i)
    many +=
        "ROBOTLASER1 0 -1.5 3.0 0.0" + std::to_string(100 + i) + " 50.0 0.01 0 2 1 1 0 0 0 0 0 0 0 0 0 0 0 0 1 h 1\n";
  EXPECT_EQ(message(many), "line 201: more than 200 kinds of scans");
  EXPECT_EQ(message("hello\n"), "no FLASER or ROBOTLASER1 line");
}

}  // namespace
}  // namespace lapwing::slam
