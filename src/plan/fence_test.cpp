#include "plan/fence.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::plan {
namespace {

using namespace std::chrono_literals;
using base::from_seconds;
using base::to_seconds;

Ring square(double half_m, LevelPoint center = {}) {
  double const n = center.x();
  double const e = center.y();
  return {{n - half_m, e - half_m}, {n - half_m, e + half_m}, {n + half_m, e + half_m}, {n + half_m, e - half_m}};
}

Zone zone(Zone::Kind kind, Ring ring) {
  return {.name = "z", .kind = kind, .polygons = {{{std::move(ring)}}}, .lowest_m = {}, .highest_m = {}};
}

TrackPoint point(double time_s, double north, double east, double up = 20.0) {
  return {from_seconds(time_s), {north, east, -up}};
}

constexpr auto inclusion = Zone::Kind::inclusion;
constexpr auto exclusion = Zone::Kind::exclusion;

TEST(Breaches, NoneInsideAndNoneWithoutAFence) {
  Track const track{point(0, 0, 0), point(10, 5, 5)};
  EXPECT_TRUE(breaches(track, {}).empty());
  EXPECT_TRUE(breaches(track, {{zone(inclusion, square(10))}}).empty());
  EXPECT_TRUE(breaches(track, {{zone(exclusion, square(2, {50, 50}))}}).empty());
}

TEST(Breaches, TellWhenAndHowFarAVehicleWasOutside) {
  Track const track{point(0, 0, 0), point(10, 20, 0), point(20, 0, 0)};
  auto const found = breaches(track, {{zone(inclusion, square(10))}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(to_seconds(found[0].begin), 5.0, 1e-6);
  EXPECT_NEAR(to_seconds(found[0].end), 15.0, 1e-6);
  EXPECT_NEAR(found[0].depth_m, 10.0, 1e-9);
  EXPECT_EQ(found[0].worst.time, 10s);
  EXPECT_FALSE(found[0].by_height);
  EXPECT_EQ(found[0].zone, "z");
}

TEST(Breaches, FindACornerThatIsCutBetweenTwoPoints) {
  Track const track{point(0, 20, 0), point(1, 0, 19)};  // passes the corner (10, 10) at its inside
  auto const found = breaches(track, {{zone(exclusion, square(10))}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(found[0].begin, 0s);
  EXPECT_LT(found[0].end, 1s);
  EXPECT_GT(found[0].depth_m, 0.01);
}

TEST(Breaches, OneInclusionOfSeveralSuffices) {
  Fence const fence{{zone(inclusion, square(10)), zone(inclusion, square(10, {0, 19}))}};
  Track const track{point(0, 0, 0), point(10, 0, 25)};
  EXPECT_TRUE(breaches(track, fence).empty());
  Track const beyond{point(0, 0, 0), point(10, 0, 39)};
  auto const found = breaches(beyond, fence);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].depth_m, 10.0, 1e-9);
}

TEST(Breaches, WatchTheUpperLimitExactly) {
  auto low = zone(inclusion, square(100));
  low.highest_m = 30.0;
  Track const track{point(0, 0, 0, 0), point(10, 0, 0, 50), point(20, 0, 0, 0)};
  auto const found = breaches(track, {{low}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(to_seconds(found[0].begin), 6.0, 1e-6);
  EXPECT_NEAR(to_seconds(found[0].end), 14.0, 1e-6);
  EXPECT_NEAR(found[0].depth_m, 20.0, 1e-9);
  EXPECT_TRUE(found[0].by_height);
}

TEST(Breaches, WatchTheLowerLimitOnlyBetweenTakeOffAndLanding) {
  auto high = zone(inclusion, square(100));
  high.lowest_m = 15.0;
  Track const good{point(0, 0, 0, 0), point(10, 0, 0, 20), point(20, 9, 0, 20), point(30, 9, 0, 0)};
  EXPECT_TRUE(breaches(good, {{high}}).empty());
  Track const dips{point(0, 0, 0, 0), point(10, 0, 0, 20), point(20, 9, 0, 10), point(30, 9, 0, 20),
                   point(40, 9, 0, 0)};
  auto const found = breaches(dips, {{high}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].depth_m, 5.0, 1e-9);
  Track const stays_down{point(0, 0, 0, 0), point(10, 50, 0, 0)};
  EXPECT_TRUE(breaches(stays_down, {{high}}).empty());
}

TEST(Breaches, AnExclusionHasAFloorAndACeiling) {
  auto tower = zone(exclusion, square(10));
  tower.highest_m = 30.0;
  Track const above{point(0, -50, 0, 31), point(10, 50, 0, 31)};
  EXPECT_TRUE(breaches(above, {{tower}}).empty());
  Track const into{point(0, -50, 0, 28), point(10, 50, 0, 28)};
  auto const found = breaches(into, {{tower}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].depth_m, 2.0, 1e-9);
  EXPECT_TRUE(found[0].by_height);
}

TEST(Breaches, FlyingAlongAnEdgeIsNone) {
  Track track;
  for (int i = 0; i < 100; ++i) track.push_back(point(i, 10.0 + 1e-7 * (i % 3 - 1), -9.0 + 0.18 * i));
  EXPECT_TRUE(breaches(track, {{zone(inclusion, square(10))}}).empty());
}

// The times outside add up to what dense sampling finds, however the track was cut into stretches.
TEST(Breaches, AgreeWithDenseSamplingOfRandomFlights) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> spread(-40.0, 40.0);
  for (int round = 0; round < 60; ++round) {
    Ring star;
    for (int i = 0; i < 9; ++i) {
      double const angle = 2.0 * std::numbers::pi * i / 9.0;
      double const radius = 12.0 + 0.5 * std::abs(spread(random));
      star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    Track track;
    for (int i = 0; i < 12; ++i) track.push_back(point(2.0 * i, spread(random), spread(random)));
    Polygon const polygon{{star}};
    for (auto const kind : {inclusion, exclusion}) {
      double inside_of_breaches_s = 0.0;
      for (auto const& breach : breaches(track, {{zone(kind, star)}}))
        inside_of_breaches_s += to_seconds(breach.end - breach.begin);
      int sampled = 0;
      for (auto time = 1ms; time <= 22s; time += 1ms) {
        auto const at = place_at(track, time);
        if (contains(polygon, {at.north, at.east}) == (kind == exclusion)) ++sampled;
      }
      EXPECT_NEAR(inside_of_breaches_s, sampled * 1e-3, 0.02);
    }
  }
}

}  // namespace
}  // namespace lapwing::plan
