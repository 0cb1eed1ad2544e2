#include "robot/planner/driven_track.hpp"

#include <array>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using explore::Place;

struct DrivenTrackTest : ::testing::Test {
  explore::KnownMap map{60, 40, 0.1, {.keep_off_m = 0.23, .wary_m = 0.5}};
  DrivenTrack track;
};

TEST_F(DrivenTrackTest, CanBeStoodOnWhateverTheMapShows) {
  map.learn({12, 10}, explore::Knowledge::wall);
  track.lay(map, std::array{Place(1.05, 1.05), Place(1.55, 1.05)});
  for (int x = 10; x <= 15; ++x) EXPECT_TRUE(map.is_standable({x, 10})) << x;
  EXPECT_TRUE(map.is_tight({12, 10}));
  EXPECT_FALSE(map.is_standable({12, 11}));
  EXPECT_FALSE(map.is_standable({16, 10}));
}

TEST_F(DrivenTrackTest, MovesWithTheMapThatALoopHasMoved) {
  track.lay(map, std::array{Place(1.05, 1.05), Place(1.55, 1.05), Place(1.95, 1.05)});
  track.lay(map, std::array{Place(1.05, 1.05), Place(1.55, 1.05), Place(1.95, 1.35), Place(2.05, 1.35)});
  EXPECT_TRUE(map.is_standable({12, 10})) << "as it was";
  EXPECT_FALSE(map.is_standable({19, 10}));
  EXPECT_TRUE(map.is_standable({19, 13}));
  EXPECT_TRUE(map.is_standable({20, 13}));
  track.lay(map, {});
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 60; ++x) EXPECT_FALSE(map.is_standable({x, y})) << x << ", " << y;
}

TEST_F(DrivenTrackTest, LeadsNotThroughWhatItWasCarriedOver) {
  track.lay(map, std::array{Place(1.05, 1.05), Place(3.05, 1.05)});
  EXPECT_TRUE(map.is_standable({10, 10}));
  EXPECT_TRUE(map.is_standable({30, 10}));
  EXPECT_FALSE(map.is_standable({20, 10}));
}

TEST_F(DrivenTrackTest, LeadsAwayFromWhatTheRobotDoesNotSee) {
  // Nothing is known of what lies to the right of where it stands.
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 20; ++x) map.learn({x, y}, explore::Knowledge::free);
  track.lay(map, std::array{Place(1.95, 2.05)});
  for (int x = 3; x < 20; ++x) EXPECT_TRUE(map.is_standable({x, 20})) << x;
  EXPECT_FALSE(map.is_standable({19, 21})) << "it would go along what is unknown";
  EXPECT_FALSE(map.is_standable({20, 20}));
  track.lay(map, std::array{Place(1.95, 2.05), Place(1.45, 2.05)});
  EXPECT_TRUE(map.is_standable({18, 20})) << "it came along there";
  EXPECT_FALSE(map.is_standable({18, 21})) << "it is away now";
}

TEST_F(DrivenTrackTest, LeadsNowhereBetweenTwoWalls) {
  for (int y = 19; y <= 21; ++y)
    for (int x = 0; x < 60; ++x) map.learn({x, y}, explore::Knowledge::free);
  track.lay(map, std::array{Place(1.95, 2.05)});
  EXPECT_TRUE(map.is_standable({19, 20}));
  EXPECT_FALSE(map.is_standable({18, 20}));
  EXPECT_FALSE(map.is_standable({20, 20}));
}

}  // namespace
}  // namespace lapwing::robot
