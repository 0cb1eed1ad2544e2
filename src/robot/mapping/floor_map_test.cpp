// A simulated drive through an office, scan by scan.
#include "robot/mapping/floor_map.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "slam/graph/pose_graph.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::robot {
namespace {

using slam::Pose2;

slam::testing::Drive ring_drive() {
  auto const building = slam::testing::office(16.0, 8.0, 4.0, 1.0, 3);
  std::vector<Eigen::Vector2d> const way{{0, 0}, {16, 0}, {16, 8}, {0, 8}, {0, 0}, {6, 0}};
  slam::testing::DriveOptions options;
  options.most_range_m = 12.0;
  return slam::testing::drive(building, way, options);
}

struct Mapped {
  FloorMap map;
  std::vector<Pose2> poses;
};

Mapped map_of(slam::testing::Drive const& drive, std::size_t scans, MappingOptions const& options = {}) {
  Mapped mapped{FloorMap(drive.log.sensors.front(), options), {}};
  for (std::size_t i = 0; i < scans; ++i) {
    mapped.map.add(drive.log.scans[i]);
    mapped.poses.push_back(mapped.map.here().pose);
  }
  return mapped;
}

std::vector<Pose2> truth_of(FloorMap const& map, slam::testing::Drive const& drive) {
  std::vector<Pose2> truth;
  for (std::size_t i = 0, next = 0; i < drive.log.scans.size() && next < map.graph().frames.size(); ++i) {
    if (map.key_time(next) != drive.log.scans[i].time) continue;
    truth.push_back(drive.truth[i]);
    ++next;
  }
  return truth;
}

TEST(FloorMap, KnowsWhereTheRobotIsBetterThanItsWheelsDo) {
  auto const drive = ring_drive();
  auto const mapped = map_of(drive, drive.log.scans.size());
  std::vector<Pose2> wheels;
  for (auto const& scan : drive.log.scans) wheels.push_back(scan.odometry);
  double const by_map = slam::testing::greatest_error_m(mapped.map.graph().poses, truth_of(mapped.map, drive));
  EXPECT_LT(by_map, 0.1);
  EXPECT_GT(slam::testing::greatest_error_m(wheels, drive.truth), 3.0 * by_map);
}

TEST(FloorMap, BeginsWhereTheRobotDoes) {
  auto drive = ring_drive();
  for (auto& scan : drive.log.scans) scan.odometry = Pose2{100.0, 50.0, 2.0} * scan.odometry;
  auto const mapped = map_of(drive, 30);
  EXPECT_EQ(mapped.poses.front(), Pose2{});
  EXPECT_NEAR(mapped.poses.back().x, drive.truth[29].x, 0.1);
  EXPECT_NEAR(mapped.poses.back().y, drive.truth[29].y, 0.1);
}

/// What a scan sees when somebody stands in it, in the robot's frame.
void put_before(slam::Scan& scan, slam::Sensor const& sensor, Eigen::Vector2d const& person) {
  constexpr double radius_m = 0.25;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    double const bearing = sensor.bearings_rad[i];
    Eigen::Vector2d const way(std::cos(bearing), std::sin(bearing));
    double const along_m = way.dot(person);
    double const aside_m = std::abs(way.x() * person.y() - way.y() * person.x());
    if (along_m <= 0.0 || aside_m >= radius_m) continue;
    auto const range_m = static_cast<float>(along_m - std::sqrt(radius_m * radius_m - aside_m * aside_m));
    scan.ranges_m[i] = std::min(scan.ranges_m[i], range_m);
  }
}

TEST(FloorMap, IsNotTakenAlongByWhoWalksBeforeTheRobot) {
  slam::testing::DriveOptions options;
  options.most_range_m = 8.0;
  auto drive = slam::testing::drive(slam::testing::comb(5, 6.0, 3.0), {{0, 0}, {24, 0}}, options);
  for (std::size_t i = 30; i < drive.log.scans.size(); ++i) {
    double const sway_m = 0.02 * std::sin(0.7 * static_cast<double>(i));
    put_before(drive.log.scans[i], drive.log.sensors.front(), {0.8 + sway_m, 0.1});
    put_before(drive.log.scans[i], drive.log.sensors.front(), {0.9 - sway_m, -0.5});
  }
  auto const mapped = map_of(drive, drive.log.scans.size());
  EXPECT_NEAR(mapped.poses.back().x, drive.truth.back().x, 0.4);
  MappingOptions wary;
  wary.front_end.odometry_spread = 1.0;
  auto const dragged = map_of(drive, drive.log.scans.size(), wary);
  EXPECT_LT(dragged.poses.back().x, drive.truth.back().x - 1.0) << "or this test shows nothing";
}

/// Along a corridor that shows next to nothing but the people who come towards the robot, one after the other.
slam::testing::Drive drive_past_people(std::uint64_t seed) {
  slam::testing::Building const corridor{{{-10, -1.4}, {40, -1.4}},
                                         {{-10, 1.4}, {40, 1.4}},
                                         {{12, 1.4}, {12, 1.2}},
                                         {{13, 1.4}, {13, 1.2}},
                                         {{20, -1.4}, {20, -1.2}}};
  auto drive = slam::testing::drive(corridor, {{0, 0}, {24, 0}},
                                    {.beams = 360,
                                     .field_of_view_rad = 2.0 * std::numbers::pi,
                                     .most_range_m = 8.0,
                                     .shift_noise = 0.02,
                                     .scale_bias = 0.0,
                                     .seed = seed});
  constexpr double step_m = 0.2;  // between two scans
  constexpr double least_m = 0.4;
  for (std::size_t i = 0; i < drive.log.scans.size(); ++i) {
    auto const& pose = drive.truth[i];
    for (double const begins_m : {6.0, 12.0, 20.0, 30.0, 40.0}) {
      Eigen::Vector2d const there(begins_m - step_m * static_cast<double>(i) - pose.x, 0.6 - pose.y);
      if (there.norm() > least_m)
        put_before(drive.log.scans[i], drive.log.sensors.front(), Eigen::Rotation2Dd(-pose.yaw) * there);
    }
  }
  return drive;
}

TEST(FloorMap, IsNotTakenAlongByWhoComesTowardsTheRobot) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    auto const drive = drive_past_people(seed);
    auto const mapped = map_of(drive, drive.log.scans.size());
    double most_m = 0.0;
    for (std::size_t i = 0; i < drive.truth.size(); ++i)
      most_m = std::max(most_m, slam::distance_m(mapped.poses[i], drive.truth[i]));
    EXPECT_LT(most_m, 0.15) << "seed " << seed;
  }
  MappingOptions as_for_logs;
  as_for_logs.front_end.may_be_refuted = true;
  auto const drive = drive_past_people(1);
  auto const without_them = map_of(drive, drive.log.scans.size(), as_for_logs);
  EXPECT_LT(slam::distance_m(without_them.poses.back(), drive.truth.back()), 0.15);
  as_for_logs.leaves_out_who_walks = false;
  auto const taken_along = map_of(drive, drive.log.scans.size(), as_for_logs);
  EXPECT_GT(slam::distance_m(taken_along.poses.back(), drive.truth.back()), 1.0) << "or this test shows nothing";
}

TEST(FloorMap, StaysWhereTheRobotDoesWhenItsWheelsSpinAlongAWall) {
  slam::testing::Building const room{
      {{-2, -0.6}, {5, -0.6}}, {{5, -0.6}, {5, 3}}, {{5, 3}, {-2, 3}}, {{-2, 3}, {-2, -0.6}}};
  auto drive = slam::testing::drive(room, {{0, 0}, {4, 0}},
                                    {.beams = 360, .field_of_view_rad = 2.0 * std::numbers::pi, .most_range_m = 8.0});
  // It drives for 2 m, then its wheels turn and it does not get on, then it drives again.
  auto const begins = drive.log.scans.size() / 2;
  auto const& stuck = drive.log.scans[begins];
  constexpr int while_spinning = 30;
  constexpr double step_m = 0.1;
  auto const on = [&](slam::Scan scan, int steps) {
    scan.odometry = scan.odometry * Pose2{.x = step_m * steps};
    return scan;
  };
  std::vector<slam::Scan> scans(drive.log.scans.begin(), drive.log.scans.begin() + static_cast<std::ptrdiff_t>(begins));
  for (int i = 0; i < while_spinning; ++i) scans.push_back(on(stuck, i));
  for (auto i = begins; i < drive.log.scans.size(); ++i) scans.push_back(on(drive.log.scans[i], while_spinning));
  FloorMap map(drive.log.sensors.front(), {});
  for (std::size_t i = 0; i < begins + while_spinning; ++i) map.add(scans[i]);
  EXPECT_LT(slam::distance_m(map.here().pose, drive.truth[begins]), 0.25) << "a key frame's step, as wheels have it";
  for (auto i = begins + while_spinning; i < scans.size(); ++i) map.add(scans[i]);
  EXPECT_LT(slam::distance_m(map.here().pose, drive.truth.back()), 0.1);
}

TEST(FloorMap, DrawsWhatIsTakenAndWhatIsFree) {
  auto const drive = ring_drive();
  auto mapped = map_of(drive, 60);
  auto const& grid = mapped.map.grid();
  auto const at = [&](double x, double y) { return grid.at(grid.cell_at({x, y})); };
  EXPECT_LT(at(1.0, 0.0).probability(), 0.2) << "the middle of the corridor";
  EXPECT_FALSE(at(8.0, 20.0).is_seen()) << "beyond the building";
  auto const changes = mapped.map.take_changes();
  EXPECT_FALSE(changes.empty());
  EXPECT_TRUE(mapped.map.take_changes().empty()) << "told once";
  for (auto const key : changes) EXPECT_TRUE(grid.tiles().contains(key));
}

TEST(FloorMap, LiesWhereTheSiteHasIt) {
  auto const drive = ring_drive();
  MappingOptions options;
  options.site_from_map = {geo::Point<geo::SiteFrame>(20.0, 30.0), 1.0};
  auto const mapped = map_of(drive, 5, options);
  EXPECT_EQ(mapped.map.grid().site_from_grid().origin(), geo::Point<geo::SiteFrame>(20.0, 30.0));
}

TEST(FloorMap, IsLessSureBetweenKeyFrames) {
  auto const drive = ring_drive();
  FloorMap map(drive.log.sensors.front(), {});
  std::size_t i = 0;
  for (; i < 40; ++i) map.add(drive.log.scans[i]);
  int compared = 0;
  double at_key_frame = 0.0;
  for (; i < 60; ++i) {
    auto const frames = map.graph().size();
    map.add(drive.log.scans[i]);
    auto const spread = map.here().covariance.trace();
    EXPECT_GT(spread, 0.0);
    EXPECT_LT(std::sqrt(map.here().covariance(0, 0)), 0.2);
    if (map.graph().size() != frames) {
      at_key_frame = spread;
    } else if (at_key_frame > 0.0) {
      EXPECT_GT(spread, at_key_frame);
      ++compared;
    }
  }
  EXPECT_GT(compared, 0);
}

std::vector<Pose2> done(std::unique_ptr<slam::JointAlignment> alignment) {
  while (!alignment->is_done()) alignment->go_on(1000, slam::one_by_one);
  return alignment->graph().poses;
}

TEST(FloorMap, IsAlignedWhileItGrows) {
  auto const drive = ring_drive();
  auto const half = drive.log.scans.size() / 2;
  auto mapped = map_of(drive, half);
  auto& map = mapped.map;
  auto alignment = map.begin_alignment();
  auto const frames = map.graph().size();
  for (auto i = half; i < half + 20; ++i) map.add(drive.log.scans[i]);
  ASSERT_GT(map.graph().size(), frames);
  auto const before_m = slam::testing::greatest_error_m(map.graph().poses, truth_of(map, drive));
  auto const last = map.graph().poses[frames - 1];
  auto const since = slam::between(last, map.here().pose);
  auto const aligned = done(std::move(alignment));
  map.take(aligned);
  EXPECT_LT(slam::testing::greatest_error_m(map.graph().poses, truth_of(map, drive)), before_m);
  EXPECT_NE(map.graph().poses[frames - 1], last);
  EXPECT_EQ(map.graph().poses[frames - 1], aligned.back());
  EXPECT_LT(slam::distance_m(slam::between(aligned.back(), map.here().pose), since), 1e-9) << "carried along";
  for (auto i = half + 20; i < drive.log.scans.size(); ++i) map.add(drive.log.scans[i]);
  EXPECT_LT(slam::testing::greatest_error_m(map.graph().poses, truth_of(map, drive)), 0.1);
}

TEST(FloorMap, TellsHowItHasMoved) {
  auto const drive = ring_drive();
  auto map = map_of(drive, drive.log.scans.size() / 2).map;
  (void)map.take_shifts();
  auto const before = map.graph().poses;
  map.take(done(map.begin_alignment()));
  auto const shifts = map.take_shifts();
  ASSERT_EQ(shifts.size(), 1U);
  EXPECT_TRUE(map.take_shifts().empty()) << "told once";
  Pose2 const beside{0.0, 1.0, 0.5};
  for (std::size_t k = 0; k < before.size(); k += 10)
    EXPECT_LT(slam::distance_m(shifts[0].moved(before[k]), map.graph().poses[k]), 0.02);
  auto const moved = shifts[0].moved(before.back() * beside);
  EXPECT_LT(slam::distance_m(moved, map.graph().poses.back() * beside), 0.02);
}

TEST(FloorMap, MeasuresAnewWhatWasAligned) {
  auto const drive = ring_drive();
  auto aligned_map = map_of(drive, drive.log.scans.size()).map;
  auto const closures = aligned_map.loops().closures;
  EXPECT_GT(closures, 0);
  auto const aligned = done(aligned_map.begin_alignment());
  aligned_map.take(aligned);
  for (auto const& constraint : aligned_map.graph().constraints)
    EXPECT_LT(slam::error_of(constraint, aligned).norm(), 1e-9) << "or the next loop would undo it";
}

TEST(FloorMap, WantsToBeAlignedAfterAPartOfItsWay) {
  auto const drive = ring_drive();
  FloorMap map(drive.log.sensors.front(), {});
  EXPECT_FALSE(map.wants_alignment(false));
  EXPECT_FALSE(map.wants_alignment(true)) << "of nothing";
  std::size_t i = 0;
  while (i < drive.log.scans.size() && !map.wants_alignment(false)) map.add(drive.log.scans[i++]);
  ASSERT_LT(i, drive.log.scans.size());
  double driven_m = 0.0;
  for (std::size_t k = 1; k < i; ++k) driven_m += slam::distance_m(drive.truth[k - 1], drive.truth[k]);
  EXPECT_NEAR(driven_m, MappingOptions{}.align_every_m, 2.0);
  EXPECT_TRUE(map.wants_alignment(true));
  auto const alignment = map.begin_alignment();
  EXPECT_FALSE(map.wants_alignment(false));
  EXPECT_FALSE(map.wants_alignment(true)) << "nothing is new";
  for (int more = 0; more < 10; ++more) map.add(drive.log.scans[i++]);
  EXPECT_TRUE(map.wants_alignment(true));
}

/// So many rounds through the corridors of a small office.
slam::testing::Drive rounds(int count) {
  std::vector<Eigen::Vector2d> way{{0, 0}};
  for (int i = 0; i < count; ++i) way.insert(way.end(), {{10, 0}, {10, 8}, {0, 8}, {0, 0}});
  return slam::testing::drive(slam::testing::office(10.0, 8.0, 4.0, 1.0, 5), way, {.beams = 91, .scans_per_s = 2.5});
}

MappingOptions of_three_passes() {
  MappingOptions options;
  options.prune.passes = 3;
  return options;
}

TEST(FloorMap, DoesNotGrowWhereTheRobotDrivesAgainAndAgain) {
  auto const few = rounds(5);
  auto const many = rounds(9);
  auto const after_few = map_of(few, few.log.scans.size(), of_three_passes()).map;
  auto const after_many = map_of(many, many.log.scans.size(), of_three_passes()).map;
  EXPECT_LT(after_many.graph().size(), 1.3 * after_few.graph().size());
  EXPECT_LT(slam::testing::greatest_error_m(after_many.graph().poses, truth_of(after_many, many)), 0.15);
  EXPECT_GT(after_many.loops().closures, after_few.loops().closures) << "of what was let go, too";
}

TEST(FloorMap, LetsNothingGoWhileItIsAligned) {
  auto const drive = rounds(6);
  auto const half = drive.log.scans.size() / 2;
  auto mapped = map_of(drive, half, of_three_passes());
  auto& map = mapped.map;
  auto alignment = map.begin_alignment();
  auto const frames = map.graph().size();
  for (auto i = half; i + 200 < drive.log.scans.size(); ++i) map.add(drive.log.scans[i]);
  auto const most = map.graph().size();
  auto const aligned = done(std::move(alignment));
  ASSERT_EQ(static_cast<int>(aligned.size()), frames);
  map.take(aligned);
  for (auto i = drive.log.scans.size() - 200; i < drive.log.scans.size(); ++i) map.add(drive.log.scans[i]);
  EXPECT_LT(map.graph().size(), most) << "what was put off";
  EXPECT_LT(slam::testing::greatest_error_m(map.graph().poses, truth_of(map, drive)), 0.1);
}

TEST(FloorMap, IsTheSameForTheSameScans) {
  auto const drive = ring_drive();
  auto const one = map_of(drive, 120);
  auto const two = map_of(drive, 120);
  EXPECT_EQ(one.poses, two.poses);
  ASSERT_EQ(one.map.grid().tiles().size(), two.map.grid().tiles().size());
  for (auto const& [key, tile] : one.map.grid().tiles()) EXPECT_EQ(tile->cells, two.map.grid().tiles().at(key)->cells);
}

/// Twice round a ring of corridors with rangers at right angles that see 4 m.
slam::testing::Drive drive_of_few_rangers(double turn_bias_per_m = 0.003) {
  auto const building = slam::testing::office(16.0, 8.0, 4.0, 1.0, 3);
  std::vector<Eigen::Vector2d> const way{{0, 0}, {16, 0}, {16, 8}, {0, 8}, {0, 0}, {16, 0}, {16, 8}, {0, 8}, {0, 0}};
  slam::testing::DriveOptions options;
  options.beams = 5;  // the first and the last look back
  options.field_of_view_rad = 2.0 * std::numbers::pi;
  options.most_range_m = 4.0;
  options.scans_per_s = 12.0;
  options.turn_bias_per_m = turn_bias_per_m;
  return slam::testing::drive(building, way, options);
}

TEST(FloorMap, OfFewRangersKnowsWhereTheRobotIsBetterThanItsWheelsDo) {
  auto const drive = drive_of_few_rangers();
  auto const mapped = map_of(drive, drive.log.scans.size());
  std::vector<Pose2> wheels;
  for (auto const& scan : drive.log.scans) wheels.push_back(scan.odometry);
  double const by_map = slam::testing::greatest_error_m(mapped.map.graph().poses, truth_of(mapped.map, drive));
  EXPECT_GT(mapped.map.loops().closures, 0);
  EXPECT_LT(by_map, 0.5);
  EXPECT_GT(slam::testing::greatest_error_m(wheels, drive.truth), 3.0 * by_map);
}

TEST(FloorMap, OfSonarsHeadsByTheWallsWhereItsWheelsPullToOneSide) {
  auto drive = drive_of_few_rangers(0.009);
  drive.log.sensors.front().half_cone_rad = 0.13F;
  auto const mapped = map_of(drive, drive.log.scans.size());
  auto const& poses = mapped.map.graph().poses;
  auto const truth = truth_of(mapped.map, drive);
  for (std::size_t k = 0; k < poses.size(); ++k)
    EXPECT_LT(slam::turn_rad(slam::between(truth.front(), truth[k]), poses[k]), 0.22)
        << k << ", by what its echoes are laid on it would be 0.29";
}

TEST(FloorMap, OfFewRangersDrawsWhatEachScanSawAndNotKeyFramesAlone) {
  auto const drive = drive_of_few_rangers();
  auto const mapped = map_of(drive, 80);
  // Of the corridor behind it, from wall to wall.
  auto const& grid = mapped.map.grid();
  double const come_m = mapped.map.here().pose.x;
  ASSERT_GT(come_m, 2.0);
  int cells = 0;
  int free = 0;
  for (double x = 0.3; x < come_m - 0.3; x += 0.1) {
    for (double y = -0.8; y <= 0.8; y += 0.2, ++cells) {
      auto const cell = grid.at(grid.cell_at({x, y}));
      free += cell.is_seen() && cell.probability() < 0.5 ? 1 : 0;
    }
  }
  EXPECT_GT(free, 0.8 * cells) << "where doors stand open nothing comes back";
  EXPECT_LT(mapped.map.graph().size(), 8);
  auto const way = mapped.map.way();
  for (std::size_t i = 1; i < way.size(); ++i) EXPECT_LT(slam::distance_m(way[i - 1], way[i]), 0.5);
}

}  // namespace
}  // namespace lapwing::robot
