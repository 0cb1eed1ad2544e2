#include "explore/lot/fence_routes.hpp"

#include <random>

#include <gtest/gtest.h>

namespace lapwing::explore {
namespace {

using Fence = geo::Polygon<geo::SiteFrame>;

/// 60 m by 40 m, its upper right quarter cut out.
Fence with_corner() {
  return {{{{0, 0}, {60, 0}, {60, 20}, {30, 20}, {30, 40}, {0, 40}}}};
}

/// 60 m by 40 m with a house in the middle.
Fence with_house() {
  return {{{{0, 0}, {60, 0}, {60, 40}, {0, 40}}, {{25, 15}, {35, 15}, {35, 25}, {25, 25}}}};
}

/// Every half metre of the way lies in the fence, with what margin there is.
void expect_within(Fence const& fence, map::SitePoint from, std::vector<map::SitePoint> const& route, double margin_m) {
  for (auto const& to : route) {
    double const way_m = geo::distance_m(from, to);
    for (double along_m = 0.0; along_m <= way_m; along_m += 0.5) {
      auto const at = from + (along_m / way_m) * (to - from);
      ASSERT_TRUE(geo::contains(fence, at)) << at.x() << ' ' << at.y();
      ASSERT_GE(geo::distance_to_edge_m(fence, at), margin_m - 1e-6) << at.x() << ' ' << at.y();
    }
    from = to;
  }
}

TEST(FenceRoutes, StraightWhereThatIsWithin) {
  auto const routes = FenceRoutes::make(with_corner(), 2.0).value();
  auto const route = routes.route({5, 5}, {50, 10});
  ASSERT_EQ(route.size(), 1U);
  EXPECT_EQ(route[0], map::SitePoint(50, 10));
}

TEST(FenceRoutes, RoundCornersAndHouses) {
  auto const corner = FenceRoutes::make(with_corner(), 2.0).value();
  auto const round_corner = corner.route({20, 36}, {55, 15});
  EXPECT_GE(round_corner.size(), 2U);
  expect_within(with_corner(), {20, 36}, round_corner, 2.0);
  EXPECT_LT(route_length_m({20, 36}, round_corner), 48.0) << "the straight way is 41 m";
  auto const house = FenceRoutes::make(with_house(), 2.0).value();
  auto const round_house = house.route({10, 20}, {50, 20});
  EXPECT_GE(round_house.size(), 3U);
  expect_within(with_house(), {10, 20}, round_house, 2.0);
  EXPECT_LT(route_length_m({10, 20}, round_house), 48.0);
}

TEST(FenceRoutes, EveryRouteBetweenAnyPlacesStaysWithin) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> x(0.0, 60.0);
  std::uniform_real_distribution<double> y(0.0, 40.0);
  for (auto const& fence : {with_corner(), with_house()}) {
    auto const routes = FenceRoutes::make(fence, 2.0).value();
    for (int i = 0; i < 200; ++i) {
      map::SitePoint const from(x(random), y(random));
      map::SitePoint const to(x(random), y(random));
      auto const route = routes.route(from, to);
      if (!routes.contains(from)) continue;
      EXPECT_EQ(route.empty(), !routes.contains(to));
      expect_within(fence, from, route, 2.0);
    }
  }
}

TEST(FenceRoutes, FromWithinTheMarginTheWayLeadsBackIn) {
  auto const routes = FenceRoutes::make(with_house(), 2.0).value();
  auto const route = routes.route({0.5, 20.0}, {10.0, 20.0});
  ASSERT_FALSE(route.empty());
  expect_within(with_house(), {0.5, 20.0}, route, 0.49);
  EXPECT_TRUE(routes.route({10.0, 20.0}, {0.5, 20.0}).empty()) << "but not out";
  EXPECT_TRUE(routes.route({-3.0, 20.0}, {10.0, 20.0}).empty());
}

TEST(FenceRoutes, RefusesWithTheReason) {
  EXPECT_FALSE(FenceRoutes::make({{{{0, 0}, {10, 0}}}}, 2.0));
  EXPECT_FALSE(FenceRoutes::make(with_house(), 0.0));
  geo::Ring<geo::SiteFrame> ring;
  for (int i = 0; i < 100; ++i) ring.emplace_back(50.0 * std::cos(0.0628 * i), 50.0 * std::sin(0.0628 * i));
  auto const many = FenceRoutes::make({{ring}}, 2.0);
  ASSERT_FALSE(many);
  EXPECT_NE(many.error().message.find("100 corners"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::explore
