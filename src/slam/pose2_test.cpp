#include "slam/pose2.hpp"

#include <gtest/gtest.h>

#include "geo/transform.hpp"

namespace lapwing::slam {
namespace {

struct A {};
struct B {};
struct C {};

TEST(Pose2, ComposesAsTypedTransformsDo) {
  Pose2 const a{1.0, -2.0, 2.8};
  Pose2 const b{0.3, 4.0, 1.1};
  auto const typed = geo::Transform<A, B>({a.x, a.y}, a.yaw) * geo::Transform<B, C>({b.x, b.y}, b.yaw);
  auto const composed = a * b;
  EXPECT_NEAR(composed.x, typed.origin().x(), 1e-12);
  EXPECT_NEAR(composed.y, typed.origin().y(), 1e-12);
  EXPECT_NEAR(composed.yaw, typed.yaw_rad(), 1e-12);
}

TEST(Pose2, BetweenUndoesComposition) {
  Pose2 const a{1.0, -2.0, 2.8};
  Pose2 const b{0.3, 4.0, 1.1};
  auto const back = between(a, a * b);
  EXPECT_NEAR(distance_m(back, b), 0.0, 1e-12);
  EXPECT_NEAR(turn_rad(back, b), 0.0, 1e-12);
  EXPECT_NEAR(distance_m(inverse(a) * a, Pose2{}), 0.0, 1e-12);
}

}  // namespace
}  // namespace lapwing::slam
