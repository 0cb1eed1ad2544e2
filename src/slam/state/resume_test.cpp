#include "slam/state/resume.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "base/async/parallel_for.hpp"
#include "slam/state/state_file.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

constexpr auto quietly = [](std::string_view, double) {};

testing::Building const& building() {
  static auto const office = testing::office(20.0, 12.0, 4.0, 1.0, 5);
  return office;
}
/// Once and a half round a ring of corridors.
testing::Drive const& round_the_office() {
  static auto const drive =
      testing::drive(building(), {{0, 0}, {20, 0}, {20, 12}, {0, 12}, {0, 0}, {20, 0}, {20, 6}}, {.beams = 91});
  return drive;
}

ScanLog part_of(ScanLog const& log, std::size_t first, std::size_t last) {
  auto part = log;
  part.scans.assign(log.scans.begin() + static_cast<std::ptrdiff_t>(first),
                    log.scans.begin() + static_cast<std::ptrdiff_t>(last));
  return part;
}

/// As another process finds it.
SavedMap saved(Mapping const& mapping) {
  auto read = read_state(write_state(mapping.graph, mapping.memory));
  EXPECT_TRUE(read) << read.error().message;
  return *std::move(read);
}

SavedMap saved(ScanLog const& log) {
  return saved(map_log(log, {}, one_by_one, quietly));
}

TEST(Resume, GoesOnAsIfTheDriveHadNotBeenCut) {
  auto const& [log, truth] = round_the_office();
  auto const half = log.scans.size() / 2;
  auto const resumed =
      resume_log(saved(part_of(log, 0, half)), part_of(log, half, log.scans.size()), std::nullopt, one_by_one, quietly);
  ASSERT_TRUE(resumed) << resumed.error().message;
  EXPECT_EQ(resumed->beginning, Beginning::goes_on);
  EXPECT_GT(resumed->mapping.loops.closures, 0);
  ASSERT_EQ(resumed->mapping.trajectory.size(), truth.size());
  EXPECT_LT(testing::greatest_error_m(resumed->mapping.trajectory, truth), 0.1);
  EXPECT_EQ(resumed->mapping.memory.drives.size(), 2U);
}

TEST(Resume, GoesOnAgainAndAgain) {
  auto const& [log, truth] = round_the_office();
  auto const third = log.scans.size() / 3;
  auto mapping = map_log(part_of(log, 0, third), {}, one_by_one, quietly);
  for (auto const& part : {part_of(log, third, 2 * third), part_of(log, 2 * third, log.scans.size())}) {
    auto resumed = resume_log(saved(mapping), part, std::nullopt, one_by_one, quietly);
    ASSERT_TRUE(resumed) << resumed.error().message;
    mapping = std::move(resumed->mapping);
  }
  EXPECT_EQ(mapping.memory.past.size(), truth.size());
  EXPECT_LT(testing::greatest_error_m(mapping.trajectory, truth), 0.1);
}

TEST(Resume, KeepsTheFrameOfTheFirstDrive) {
  auto const& log = round_the_office().log;
  auto const half = log.scans.size() / 2;
  auto const before = saved(part_of(log, 0, half));
  auto const resumed = resume_log(before, part_of(log, half, log.scans.size()), std::nullopt, one_by_one, quietly);
  ASSERT_TRUE(resumed);
  EXPECT_LT(distance_m(resumed->mapping.graph.poses.front(), before.graph.poses.front()), 1e-9);
  EXPECT_LT(turn_rad(resumed->mapping.graph.poses.front(), before.graph.poses.front()), 1e-9);
}

/// From the middle of a long side on round the office, in an odometry of its own.
testing::Drive another_day() {
  auto drive = testing::drive(building(), {{10, 0}, {20, 0}, {20, 12}, {8, 12}}, {.beams = 91, .seed = 7});
  Pose2 const own{40.0, -3.0, 2.0};
  for (auto& scan : drive.log.scans) scan.odometry = own * scan.odometry;
  return drive;
}

double greatest_error_m(Mapping const& mapping, testing::Drive const& first, testing::Drive const& later) {
  auto truth = first.truth;
  truth.insert(truth.end(), later.truth.begin(), later.truth.end());
  return testing::greatest_error_m(mapping.trajectory, truth);
}

TEST(Resume, FindsWhereAnotherDayBegins) {
  auto const& first = round_the_office();
  auto const later = another_day();
  auto const resumed = resume_log(saved(first.log), later.log, std::nullopt, one_by_one, quietly);
  ASSERT_TRUE(resumed) << resumed.error().message;
  EXPECT_EQ(resumed->beginning, Beginning::found);
  EXPECT_LT(greatest_error_m(resumed->mapping, first, later), 0.12);
}

TEST(Resume, BeginsWhereItIsTold) {
  auto const& first = round_the_office();
  auto const later = another_day();
  auto const before = saved(first.log);
  // The map begins where the first drive does, which is where the building does, too.
  auto const resumed = resume_log(before, later.log, Pose2{10.2, 0.1, 0.05}, one_by_one, quietly);
  ASSERT_TRUE(resumed) << resumed.error().message;
  EXPECT_EQ(resumed->beginning, Beginning::told);
  EXPECT_LT(greatest_error_m(resumed->mapping, first, later), 0.12);
  auto const wrong = resume_log(before, later.log, Pose2{4.0, 6.0, 1.0}, one_by_one, quietly);
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("of the first scan's points lie on walls"), std::string::npos);
}

TEST(Resume, RefusesADriveThroughAnotherBuilding) {
  auto const elsewhere =
      testing::drive(testing::comb(3, 6.0, 9.0), testing::way_through_comb(3, 6.0, 9.0), {.beams = 91});
  auto log = elsewhere.log;
  for (auto& scan : log.scans) scan.odometry = Pose2{50.0, 0.0, 0.0} * scan.odometry;
  auto const resumed = resume_log(saved(round_the_office().log), log, std::nullopt, one_by_one, quietly);
  ASSERT_FALSE(resumed);
  EXPECT_EQ(resumed.error().kind, base::ErrorKind::invalid_input);
  EXPECT_FALSE(resumed.error().hint.empty());
}

TEST(Resume, RefusesNothingAndFewBeams) {
  auto const before = saved(part_of(round_the_office().log, 0, 100));
  auto const nothing = resume_log(before, part_of(round_the_office().log, 0, 0), std::nullopt, one_by_one, quietly);
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().message, "there is no scan in it");
  auto const few = resume_log(before, testing::drive(building(), {{0, 0}, {4, 0}}, {.beams = 11}).log, std::nullopt,
                              one_by_one, quietly);
  ASSERT_FALSE(few);
  EXPECT_NE(few.error().message.find("40 readings"), std::string::npos);
}

TEST(Resume, IsTheSameOnAnyNumberOfThreads) {
  auto const& log = round_the_office().log;
  auto const half = log.scans.size() / 2;
  auto const before = saved(part_of(log, 0, half));
  auto const threads = [](std::size_t count, std::function<void(std::size_t)> const& work) {
    base::parallel_for(4, count, work);
  };
  auto const rest = part_of(log, half, log.scans.size());
  auto const one = resume_log(before, rest, std::nullopt, one_by_one, quietly);
  auto const four = resume_log(before, rest, std::nullopt, threads, quietly);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->mapping.trajectory, four->mapping.trajectory);
}

}  // namespace
}  // namespace lapwing::slam
