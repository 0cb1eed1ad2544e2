#include "robot/planner/held_up/progress.hpp"

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

Place const there(5.0, 0.0);

TEST(Progress, IsToComeNearerByTheWayThatIsLeft) {
  Progress progress;
  progress.begin(0.0);
  progress.note({.time_s = 0.0, .goal = there, .left_m = 5.0});
  progress.note({.time_s = 2.0, .goal = there, .left_m = 4.5});
  EXPECT_EQ(progress.stalled_s(2.0), 0.0);
  progress.note({.time_s = 3.0, .goal = there, .left_m = 4.45});
  EXPECT_EQ(progress.stalled_s(3.0), 1.0) << "a little is noise";
  progress.note({.time_s = 4.0, .goal = there, .left_m = 4.2});
  EXPECT_EQ(progress.stalled_s(4.0), 0.0) << "a little and a little is some";
}

TEST(Progress, IsNoneToDriveToAndFro) {
  Progress progress;
  progress.begin(0.0);
  for (int i = 0; i <= 30; ++i) progress.note({.time_s = 1.0 * i, .goal = there, .left_m = i % 2 == 0 ? 4.0 : 4.6});
  EXPECT_EQ(progress.stalled_s(30.0), 30.0);
}

TEST(Progress, IsNoneToBeSentElsewhereOrToHaveNoWay) {
  Progress progress;
  progress.begin(0.0);
  progress.note({.time_s = 0.0, .goal = there, .left_m = 4.0});
  progress.note({.time_s = 5.0, .goal = Place(0.0, 3.0), .left_m = 1.0});
  progress.note({.time_s = 6.0, .goal = Place(0.0, 3.0)});
  EXPECT_EQ(progress.stalled_s(6.0), 6.0);
}

TEST(Progress, IsThatTheMapGrows) {
  Progress progress;
  progress.begin(0.0);
  progress.note({.time_s = 1.0, .free_m2 = 10.0});
  progress.note({.time_s = 2.0, .free_m2 = 10.1});
  EXPECT_EQ(progress.stalled_s(2.0), 1.0);
  progress.note({.time_s = 3.0, .free_m2 = 10.4});
  EXPECT_EQ(progress.stalled_s(3.0), 0.0);
  progress.note({.time_s = 4.0, .free_m2 = 9.0});
  progress.note({.time_s = 5.0, .free_m2 = 10.4});
  EXPECT_EQ(progress.stalled_s(5.0), 2.0) << "what was drawn anew is not new";
}

TEST(Progress, IsAlsoThatOfTheWayRoundAnObstacle) {
  Progress progress;
  progress.begin(0.0);
  progress.note({.time_s = 0.0, .goal = there, .left_m = 4.0});
  progress.allow_detour();
  progress.note({.time_s = 5.0, .goal = there, .left_m = 9.0});
  EXPECT_EQ(progress.stalled_s(5.0), 5.0) << "it has only been found";
  progress.note({.time_s = 6.0, .goal = there, .left_m = 8.7});
  EXPECT_EQ(progress.stalled_s(6.0), 0.0);
}

}  // namespace
}  // namespace lapwing::robot
