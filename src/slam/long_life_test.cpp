// A building that a robot drives through again and again: neither its graph nor its time grows with the passes, and the
// map shows what is there now.
#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "slam/mapper.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

constexpr auto quietly = [](std::string_view, double) {};

testing::Building rooms() {
  return testing::office(10.0, 8.0, 4.0, 1.0, 5);
}

/// So many rounds through the corridors, 36 m each.
std::vector<Eigen::Vector2d> rounds(int count) {
  std::vector<Eigen::Vector2d> way{{0, 0}};
  for (int i = 0; i < count; ++i) way.insert(way.end(), {{10, 0}, {10, 8}, {0, 8}, {0, 0}});
  return way;
}

testing::Drive drive(testing::Building const& building, int count) {
  return testing::drive(building, rounds(count), {.beams = 91, .scans_per_s = 2.5});
}

int const usual_passes = MapperOptions().prune.passes;

Mapping mapped(ScanLog const& log, int passes) {
  MapperOptions options;
  options.prune.passes = passes;
  return map_log(log, options, one_by_one, quietly);
}

TEST(LongLife, PassesBeyondWhatIsEnoughAddNoKeyFrames) {
  auto const few = drive(rooms(), 9);
  auto const many = drive(rooms(), 16);
  auto const after_few = mapped(few.log, usual_passes);
  auto const after_many = mapped(many.log, usual_passes);
  EXPECT_LT(after_many.graph.size(), 1.3 * after_few.graph.size());
  EXPECT_LT(after_many.graph.constraints.size(), 5U * after_many.graph.frames.size());
  EXPECT_LT(testing::greatest_error_m(after_many.trajectory, many.truth), 0.15);
  EXPECT_EQ(after_many.memory.past.size(), many.truth.size());
  std::vector<Pose2> truth;
  for (auto const& frame : after_many.graph.frames) truth.push_back(many.truth[static_cast<std::size_t>(frame.scan)]);
  EXPECT_LT(testing::greatest_error_m(after_many.graph.poses, truth), 0.1);
}

/// On the way: what is aligned at the end hides whether the oldest key frames are still tied to what is around them.
double error_on_the_way(testing::Drive const& drive) {
  Mapper mapper(MapperOptions(), RobotKind{.has_odometry = true}, one_by_one);
  for (auto const& scan : drive.log.scans) {
    mapper.follow(scan, drive.log.sensors.front());
    mapper.close_loops();
  }
  std::vector<Pose2> truth;
  for (auto const& frame : mapper.graph().frames) truth.push_back(drive.truth[static_cast<std::size_t>(frame.scan)]);
  return testing::greatest_error_m(mapper.graph().poses, truth);
}

TEST(LongLife, TheMapStaysWhereItBegan) {
  EXPECT_LT(error_on_the_way(drive(rooms(), 16)), 0.05);
}

TEST(LongLife, TheMapStaysWhereItBeganWhereFewLoopsHoldIt) {
  auto const few_beams = testing::drive(rooms(), rounds(16),
                                        {.beams = 46, .field_of_view_rad = 2.0 * std::numbers::pi, .scans_per_s = 2.5});
  EXPECT_LT(error_on_the_way(few_beams), 0.5);
}

TEST(LongLife, ChangesNothingWhereAPlaceIsPassedThrice) {
  auto const [log, truth] = drive(rooms(), 3);
  auto const with = mapped(log, usual_passes);
  auto const without = mapped(log, 1000 * usual_passes);
  EXPECT_EQ(with.trajectory, without.trajectory);
}

TEST(LongLife, IsAsSharpAsWithEveryKeyFrame) {
  auto const [log, truth] = drive(rooms(), 10);
  auto const with = testing::greatest_error_m(mapped(log, usual_passes).trajectory, truth);
  auto const without = testing::greatest_error_m(mapped(log, 1000).trajectory, truth);
  EXPECT_LT(with, without + 0.04);
}

/// How likely any cell within a decimetre and a half of that place is taken, 0 to 1.
double taken(Mapper const& mapper, Eigen::Vector2d const& place) {
  auto const grid = mapper.grid({});
  auto const middle = grid.cell_at(geo::Point<map::GridFrame>(place.x(), place.y()));
  constexpr int reach = 3;
  auto most = 0.0;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) most = std::max(most, grid.at({middle.x + x, middle.y + y}).probability());
  return most;
}

TEST(LongLife, ShowsAfterAFewPassesWhatWasMoved) {
  auto before = rooms();
  auto after = before;
  // A board across half of the corridor, first at one place and then at another.
  before.push_back({{3.02, -1.0}, {3.02, -0.45}});
  after.push_back({{6.52, -1.0}, {6.52, -0.45}});
  auto const first = drive(before, 6);
  auto const later = drive(after, 4);
  auto mapping = mapped(first.log, 3);
  Mapper mapper({.graph = std::move(mapping.graph), .memory = std::move(mapping.memory)}, one_by_one);
  mapper.begin_drive({}, Pose2{});
  for (auto const& scan : later.log.scans) {
    mapper.follow(scan, later.log.sensors[0]);
    mapper.close_loops();
  }
  mapper.finish(quietly);
  EXPECT_LT(taken(mapper, {3.02, -0.7}), 0.6);
  EXPECT_GT(taken(mapper, {6.52, -0.7}), 0.65);
  // Nothing is left of how it was.
  auto const& frames = mapper.graph().frames;
  auto const is_old = [&](KeyFrame const& frame) { return frame.scan < static_cast<int>(first.log.scans.size()); };
  EXPECT_LT(std::ranges::count_if(frames, is_old), static_cast<std::ptrdiff_t>(frames.size()) / 4);
}

}  // namespace
}  // namespace lapwing::slam
