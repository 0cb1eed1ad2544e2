#include "geo/point.hpp"

#include <gtest/gtest.h>

namespace lapwing::geo {
namespace {

struct Map {};
struct Body {};

template <class A, class B>
concept CanSubtract = requires(A a, B b) { a - b; };
template <class A, class B>
concept CanAdd = requires(A a, B b) { a + b; };

TEST(Point, DiffersFromAnotherByAShift) {
  Point<Map> const from(1.0, 2.0);
  Point<Map> const to(4.0, 6.0);
  EXPECT_EQ(to - from, (Vector<Map>(3.0, 4.0)));
  EXPECT_EQ(from + (to - from), to);
  EXPECT_EQ(to - (to - from), from);
  EXPECT_DOUBLE_EQ(distance_m(from, to), 5.0);
}

TEST(Point, OfAnotherFrameDoesNotMix) {
  EXPECT_TRUE((CanSubtract<Point<Map>, Point<Map>>));
  EXPECT_FALSE((CanSubtract<Point<Map>, Point<Body>>));
  EXPECT_FALSE((CanAdd<Point<Map>, Vector<Body>>));
  EXPECT_FALSE((CanAdd<Point<Map>, Point<Map>>)) << "two places have no sum";
  EXPECT_FALSE((CanSubtract<Point<Map>, Point3<Map>>));
}

TEST(Vector, LiesCounterclockwiseOfAnotherWhenTheCrossProductIsPositive) {
  Vector<Map> const east(1.0, 0.0);
  Vector<Map> const north(0.0, 1.0);
  EXPECT_GT(east.cross(north), 0.0);
  EXPECT_LT(north.cross(east), 0.0);
  EXPECT_EQ(2.0 * east - north, (Vector<Map>(2.0, -1.0)));
  EXPECT_DOUBLE_EQ((Vector3<Map>(2.0, 3.0, 6.0)).length(), 7.0);
}

}  // namespace
}  // namespace lapwing::geo
