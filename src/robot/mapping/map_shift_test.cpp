#include "robot/mapping/map_shift.hpp"

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using slam::Pose2;

TEST(MapShift, TakesAlongWhatIsBesideTheWayAsThatHasMoved) {
  std::vector<Pose2> const from{{0, 0, 0}, {10, 0, 0}};
  std::vector<Pose2> const to{{0, 0, 0}, {10.2, 0.5, 0.1}};
  MapShift const shift(from, to);
  EXPECT_LT(slam::distance_m(shift.moved({1, 2, 0.3}), {1, 2, 0.3}), 1e-9) << "here it did not move";
  auto const sign = shift.moved({10, 2, 0.3});
  EXPECT_NEAR(sign.x, 10.2 - 2.0 * 0.1, 0.01);
  EXPECT_NEAR(sign.y, 2.5, 0.02);
  EXPECT_NEAR(sign.yaw, 0.4, 1e-9);
}

TEST(MapShift, LeavesWhatIsFarFromAllOfTheWay) {
  std::vector<Pose2> const from{{0, 0, 0}};
  std::vector<Pose2> const to{{1, 0, 0}};
  MapShift const shift(from, to);
  EXPECT_EQ(shift.moved({20, 0, 0}), (Pose2{20, 0, 0}));
  EXPECT_EQ(MapShift({}, {}).moved({1, 2, 3}), (Pose2{1, 2, 3}));
}

}  // namespace
}  // namespace lapwing::robot
