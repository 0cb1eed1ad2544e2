#include "plan/track.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::plan {
namespace {

using namespace std::chrono_literals;
using base::from_seconds;

TrackPoint point(double time_s, double north, double east, double up = 0.0) {
  return {from_seconds(time_s), {north, east, -up}};
}

double apart(geo::Ned a, geo::Ned b) {
  return std::hypot(a.north - b.north, a.east - b.east, a.down - b.down);
}

/// A wanderer with steps of uneven length in time and space.
Track random_track(std::mt19937& random, int points) {
  std::uniform_real_distribution<double> step(-30.0, 30.0);
  std::uniform_real_distribution<double> wait(0.05, 3.0);
  Track track;
  TrackPoint at = point(wait(random), step(random), step(random), 40.0);
  for (int i = 0; i < points; ++i) {
    track.push_back(at);
    at.time += from_seconds(wait(random));
    at.place_m.north += step(random);
    at.place_m.east += step(random);
    at.place_m.down += 0.2 * step(random);
  }
  return track;
}

TEST(Track, LengthCountsHeightDifferences) {
  EXPECT_EQ(length_m({}), 0.0);
  Track const track{point(0, 0, 0), point(1, 3, 4), point(2, 3, 4, 10)};
  EXPECT_NEAR(length_m(track), 15.0, 1e-12);
  EXPECT_NEAR(greatest_height_m(track), 10.0, 1e-12);
}

TEST(Track, PlaceLiesBetweenPointsAndRestsBeyondTheEnds) {
  Track const track{point(1, 0, 0), point(3, 10, 0, 4)};
  EXPECT_EQ(place_at(track, 0s), track.front().place_m);
  EXPECT_EQ(place_at(track, 2s), (geo::Ned{5, 0, -2}));
  EXPECT_EQ(place_at(track, 9s), track.back().place_m);
}

TEST(Track, PartIncludesItsEnds) {
  Track const track{point(0, 0, 0), point(1, 1, 0), point(2, 2, 0), point(3, 3, 0)};
  EXPECT_EQ(part(track, 1s, 2s).size(), 2U);
  EXPECT_EQ(part(track, 1500ms, 1600ms).size(), 0U);
  EXPECT_EQ(part(track, -5s, 99s).size(), 4U);
}

TEST(Track, LeavesItsStartLevelNotUpwards) {
  Track const track{point(0, 0, 0), point(5, 0, 0, 50), point(6, 0, 12, 50)};
  EXPECT_EQ(left_start(track, 10.0), std::optional(base::Duration(6s)));
  EXPECT_EQ(left_start(track, 20.0), std::nullopt);
}

TEST(ClosestApproach, FindsTheMomentBetweenPoints) {
  // They cross each other's way half-way, one 3 m above the other.
  Track const a{point(0, 0, -10, 3), point(2, 0, 10, 3)};
  Track const b{point(0, 10, 0), point(2, -10, 0)};
  auto const met = closest_approach(a, b);
  ASSERT_TRUE(met);
  EXPECT_EQ(met->time, 1s);
  EXPECT_NEAR(met->distance_m, 3.0, 1e-9);
  EXPECT_NEAR(met->level_m, 0.0, 1e-9);
}

TEST(ClosestApproach, LooksOnlyAtSharedTime) {
  Track const a{point(0, 0, 0), point(1, 100, 0)};
  Track const later{point(2, 100, 0), point(3, 0, 0)};
  EXPECT_FALSE(closest_approach(a, later));
  EXPECT_FALSE(closest_approach(a, {}));
  Track const touching{point(1, 100, 5), point(3, 0, 0)};
  EXPECT_NEAR(closest_approach(a, touching)->distance_m, 5.0, 1e-9);
}

TEST(ClosestApproach, TakesTheFirstOfEqualMoments) {
  Track const a{point(0, 0, 0), point(10, 0, 0)};
  Track const b{point(0, 0, 4), point(10, 0, 4)};
  EXPECT_EQ(closest_approach(a, b)->time, 0s);
}

// Against sampling: never farther than any sample, and some moment near it is as close.
TEST(ClosestApproach, AgreesWithDenseSamplingOfRandomTracks) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    auto const a = random_track(random, 20);
    auto const b = random_track(random, 25);
    auto const found = closest_approach(a, b);
    ASSERT_TRUE(found);
    EXPECT_NEAR(apart(place_at(a, found->time), place_at(b, found->time)), found->distance_m, 1e-6);
    double sampled = 1e9;
    auto const end = std::min(a.back().time, b.back().time);
    for (auto time = std::max(a.front().time, b.front().time); time <= end; time += 1ms)
      sampled = std::min(sampled, apart(place_at(a, time), place_at(b, time)));
    EXPECT_LE(found->distance_m, sampled + 1e-9);
    EXPECT_NEAR(found->distance_m, sampled, 1.0);
  }
}

TEST(ClosestApproach, IsTheSameBothWaysAndWithMorePoints) {
  std::mt19937 random(11);
  for (int round = 0; round < 100; ++round) {
    auto const a = random_track(random, 15);
    auto const b = random_track(random, 15);
    auto finer = a;
    for (std::size_t i = 1; i < a.size(); ++i) {
      auto const middle = a[i - 1].time + (a[i].time - a[i - 1].time) / 2;
      finer.push_back({middle, place_at(a, middle)});
    }
    std::ranges::sort(finer, {}, &TrackPoint::time);
    EXPECT_NEAR(closest_approach(a, b)->distance_m, closest_approach(b, a)->distance_m, 1e-9);
    EXPECT_NEAR(closest_approach(a, b)->distance_m, closest_approach(finer, b)->distance_m, 1e-6);
    EXPECT_NEAR(length_m(a), length_m(finer), 1e-6);
  }
}

}  // namespace
}  // namespace lapwing::plan
