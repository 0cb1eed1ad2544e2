#include "slam/relations.hpp"

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

std::vector<TimedPose> const trajectory{
    {LogTime(0.0), {0.0, 0.0, 0.0}}, {LogTime(1.0), {1.0, 0.0, 0.0}}, {LogTime(2.0), {1.0, 2.0, 1.0}}};

TEST(Relations, OfTheTrajectoryItselfHaveNoError) {
  std::vector<Relation> const own{{LogTime(0.0), LogTime(2.0), {1.0, 2.0, 1.0}},
                                  {LogTime(2.0), LogTime(1.0), between(trajectory[2].pose, trajectory[1].pose)}};
  EXPECT_NEAR(component_errors(trajectory, own).shift_m.most, 0.0, 1e-12);
  EXPECT_NEAR(motion_errors(trajectory, own).shift_m.most, 0.0, 1e-12);
  EXPECT_NEAR(motion_errors(trajectory, own).turn_deg.most, 0.0, 1e-12);
}

TEST(Relations, AreCountedInTwoWays) {
  // Expected to be turned by a quarter: the components differ by nothing, the motions by the turn about the start.
  std::vector<Relation> const turned{{LogTime(0.0), LogTime(1.0), {1.0, 0.0, 1.5707963267948966}}};
  EXPECT_NEAR(component_errors(trajectory, turned).shift_m.mean, 0.0, 1e-12);
  EXPECT_NEAR(motion_errors(trajectory, turned).shift_m.mean, std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(motion_errors(trajectory, turned).turn_deg.mean, 90.0, 1e-9);
}

TEST(Relations, TakeTheNearestPoseOrOneInBetween) {
  std::vector<Relation> const between_scans{{LogTime(0.0), LogTime(0.75), {0.75, 0.0, 0.0}}};
  EXPECT_NEAR(component_errors(trajectory, between_scans).shift_m.mean, 0.25, 1e-12);
  EXPECT_NEAR(motion_errors(trajectory, between_scans).shift_m.mean, 0.0, 1e-12);
}

TEST(Relations, SpreadIsByNMinusOne) {
  std::vector<Relation> const two{{LogTime(0.0), LogTime(1.0), {0.9, 0.0, 0.0}},
                                  {LogTime(0.0), LogTime(1.0), {0.7, 0.0, 0.0}}};
  auto const shift = component_errors(trajectory, two).shift_m;
  EXPECT_NEAR(shift.mean, 0.2, 1e-12);
  EXPECT_NEAR(shift.deviation, std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(shift.mean_square, 0.05, 1e-12);
  EXPECT_NEAR(shift.most, 0.3, 1e-12);
}

TEST(Relations, AreReadWithTheirComments) {
  auto const relations = read_relations("# t1 t2 ...\n10.5 20.5 1 2 0 0 0 0.5\n\n");
  ASSERT_TRUE(relations);
  EXPECT_EQ((*relations)[0].second, LogTime(20.5));
  EXPECT_EQ((*relations)[0].motion, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_EQ(read_relations("1 2 3\n").error().message, "line 1: expected the eight numbers t1 t2 x y z roll pitch yaw");
  EXPECT_EQ(read_relations("# none\n").error().message, "no relation");
}

}  // namespace
}  // namespace lapwing::slam
