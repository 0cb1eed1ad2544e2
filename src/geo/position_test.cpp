#include "geo/position.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::geo {
namespace {

auto constexpr base = Wgs84::from_degrees(40.444233, -7.375234, 820.0);

TEST(LocalFrame, RoundTripsOffsetsToMillimetres) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> metres(-20'000.0, 20'000.0);
  LocalFrame const frame(base);
  for (int i = 0; i < 200; ++i) {
    Ned const offset{metres(random), metres(random), metres(random) / 10.0};
    auto const back = frame.ned_from(frame.place_at(offset));
    EXPECT_NEAR(back.north, offset.north, 1e-3);
    EXPECT_NEAR(back.east, offset.east, 1e-3);
    EXPECT_NEAR(back.down, offset.down, 1e-3);
  }
}

// Language spec 8.5 case 68: L2's move and loiter, from the original's own dump.
TEST(Displaced, AgreesWithTheOriginalWithinAMetre) {
  auto const moved = displaced(base, Ned{100.0, 200.0, -100.0});
  EXPECT_NEAR(moved.lat_deg(), 40.4451294, 1e-5);
  EXPECT_NEAR(moved.lon_deg(), -7.3728766, 1e-5);
}

TEST(Displaced, ChangesAltitudeByExactlyTheVerticalPart) {
  EXPECT_DOUBLE_EQ(displaced(base, Ned{3025.0, 500.0, 0.0}).alt_m, 820.0);
  EXPECT_DOUBLE_EQ(displaced(base, Ned{3025.0, 500.0, 20.0}).alt_m, 800.0);
}

TEST(SurfaceDistance, IgnoresAltitudeWhereDistanceDoesNot) {
  auto higher = base;
  higher.alt_m += 30.0;
  EXPECT_NEAR(surface_distance_m(base, higher), 0.0, 1e-6);
  EXPECT_NEAR(distance_m(base, higher), 30.0, 1e-6);
}

TEST(Bearing, IsClockwiseFromNorth) {
  EXPECT_NEAR(bearing_rad(base, displaced(base, Ned{100.0, 0.0, 0.0})), 0.0, 1e-6);
  EXPECT_NEAR(bearing_rad(base, displaced(base, Ned{0.0, 100.0, 0.0})), std::numbers::pi / 2, 1e-4);
  EXPECT_NEAR(bearing_rad(base, displaced(base, Ned{0.0, -100.0, 0.0})), 3 * std::numbers::pi / 2, 1e-4);
}

TEST(WrapPi, StaysInTheHalfOpenRangeAndKeepsTheAngle) {
  for (double angle = -20.0; angle < 20.0; angle += 0.01) {
    double const wrapped = wrap_pi(angle);
    EXPECT_GE(wrapped, -std::numbers::pi);
    EXPECT_LT(wrapped, std::numbers::pi);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-9);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-9);
  }
  EXPECT_GE(wrap_two_pi(-1e-20), 0.0);
  EXPECT_LT(wrap_two_pi(-1e-20), 2 * std::numbers::pi);
}

TEST(Disc, ContainsCountsHeight) {
  Disc const disc{base, 50.0};
  auto above = base;
  above.alt_m += 60.0;
  EXPECT_TRUE(disc.contains(displaced(base, Ned{49.0, 0.0, 0.0})));
  EXPECT_FALSE(disc.contains(above));
}

}  // namespace
}  // namespace lapwing::geo
