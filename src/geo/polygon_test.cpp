#include "geo/polygon.hpp"

#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace lapwing::geo {
namespace {

struct Map {};
using Corner = Point<Map>;

Ring<Map> square(double from, double to) {
  return {{from, from}, {to, from}, {to, to}, {from, to}};
}

Ring<Map> star(std::mt19937& random, Corner center, double least_m, double most_m) {
  std::uniform_real_distribution<double> radius(least_m, most_m);
  Ring<Map> ring;
  for (int i = 0; i < 12; ++i) {
    double const angle = 2.0 * std::numbers::pi * i / 12.0;
    ring.push_back(center + radius(random) * Vector<Map>(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

TEST(Polygon, ContainsWhatIsInItsRingAndInNoHole) {
  Polygon<Map> const yard{{square(0.0, 10.0), square(4.0, 6.0)}};
  EXPECT_TRUE(contains(yard, Corner(1.0, 1.0)));
  EXPECT_FALSE(contains(yard, Corner(5.0, 5.0)));
  EXPECT_FALSE(contains(yard, Corner(11.0, 5.0)));
  EXPECT_FALSE(contains(Polygon<Map>{}, Corner(0.0, 0.0)));
}

TEST(Polygon, SharesNoPointWithItsNeighbour) {
  Polygon<Map> const left{{{{0.0, 0.0}, {5.0, 0.0}, {5.0, 5.0}, {0.0, 5.0}}}};
  Polygon<Map> const right{{{{5.0, 0.0}, {10.0, 0.0}, {10.0, 5.0}, {5.0, 5.0}}}};
  for (double y = 0.0; y < 5.0; y += 0.25)
    EXPECT_NE(contains(left, Corner(5.0, y)), contains(right, Corner(5.0, y))) << y;
}

TEST(Polygon, HasTheAreaAndCentreThatCountingPointsGives) {
  std::mt19937 random(5);
  for (int i = 0; i < 10; ++i) {
    Corner const center(1000.0 * i, -300.0);
    Polygon<Map> polygon{{star(random, center, 5.0, 10.0), star(random, center, 1.0, 3.0)}};
    if (i % 2 == 0) std::ranges::reverse(polygon.rings[1]);
    ASSERT_EQ(polygon_fault(polygon), std::nullopt);
    auto const box = bounds(polygon);
    double count = 0.0;
    Vector<Map> sum;
    constexpr double step_m = 0.05;
    for (double x = box.least.x(); x < box.most.x(); x += step_m) {
      for (double y = box.least.y(); y < box.most.y(); y += step_m) {
        if (!contains(polygon, Corner(x, y))) continue;
        count += 1.0;
        sum = sum + (Corner(x, y) - center);
      }
    }
    EXPECT_NEAR(area_m2(polygon), count * step_m * step_m, 0.01 * area_m2(polygon));
    EXPECT_LT(distance_m(centroid(polygon), center + sum * (1.0 / count)), 0.05);
  }
}

TEST(Polygon, KnowsHowFarItsEdgeIs) {
  Polygon<Map> const yard{{square(0.0, 10.0), square(4.0, 6.0)}};
  EXPECT_DOUBLE_EQ(distance_to_edge_m(yard, Corner(5.0, 1.0)), 1.0);
  EXPECT_DOUBLE_EQ(distance_to_edge_m(yard, Corner(5.0, 3.5)), 0.5);
  EXPECT_DOUBLE_EQ(distance_to_edge_m(yard, Corner(13.0, 14.0)), 5.0);
  EXPECT_EQ(distance_to_edge_m(Polygon<Map>{}, Corner(0.0, 0.0)), std::numeric_limits<double>::infinity());
}

TEST(Polygon, HoldsTheSamePlacesTurnedAndMoved) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> spread(-50.0, 50.0);
  auto const somewhere = [&] { return Corner(spread(random), spread(random)); };
  for (int round = 0; round < 500; ++round) {
    Polygon<Map> polygon{{{}}};
    for (int i = 0; i < 7; ++i) polygon.rings[0].push_back(somewhere());
    auto const at = somewhere();
    Eigen::Rotation2Dd const turn(spread(random));
    auto const shift = somewhere();
    auto const moved = [&](Corner const& place) { return Corner(Corner::Numbers(shift.v + turn * place.v)); };
    Polygon<Map> turned{{{}}};
    for (auto const& corner : polygon.rings[0]) turned.rings[0].push_back(moved(corner));
    EXPECT_EQ(contains(polygon, at), contains(turned, moved(at)));
    EXPECT_NEAR(distance_to_edge_m(polygon, at), distance_to_edge_m(turned, moved(at)), 1e-9);
  }
}

struct Unsound {
  Polygon<Map> polygon;
  std::string fault;
};

TEST(Polygon, SaysWhyItIsNoArea) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  Unsound const cases[] = {
      {{}, "there is no ring"},
      {{{{{0.0, 0.0}, {1.0, 0.0}}}}, "the outer ring has 2 corners; it takes 3"},
      {{{{{0.0, 0.0}, {1.0, nan}, {1.0, 1.0}}}}, "corner 2 of the outer ring is not finite"},
      {{{{{0.0, 0.0}, {2.0, 2.0}, {2.0, 0.0}, {0.0, 2.0}}}}, "its edges cross or touch each other"},
      {{{square(0.0, 4.0), square(5.0, 6.0)}}, "a hole lies outside"},
      {{{square(0.0, 9.0), square(1.0, 8.0), square(2.0, 3.0)}}, "a hole lies in a hole"},
      {{{{{0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0}}}}, "an edge goes back on itself"},
      {{{{{1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}}}, "it has no extent"},
  };
  for (auto const& one : cases) EXPECT_EQ(polygon_fault(one.polygon), one.fault);
  EXPECT_EQ(polygon_fault(Polygon<Map>{{square(0.0, 9.0), square(1.0, 2.0)}}), std::nullopt);
}

TEST(Box, MeetsWhatItOverlaps) {
  Box<Map> const box{{0.0, 0.0}, {2.0, 1.0}};
  EXPECT_TRUE(box.meets({{2.0, 1.0}, {3.0, 3.0}}));
  EXPECT_FALSE(box.meets({{2.1, 0.0}, {3.0, 3.0}}));
  EXPECT_TRUE(box.contains(Corner(2.0, 0.0)));
  EXPECT_FALSE(box.contains(Corner(2.0, 1.1)));
}

}  // namespace
}  // namespace lapwing::geo
