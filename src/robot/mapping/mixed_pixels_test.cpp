#include "robot/mapping/mixed_pixels.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

/// A scanner with a beam a degree all around.
struct MixedPixels : ::testing::Test {
  MixedPixels() {
    sensor.no_return_m = 10.0F;
    for (int i = 0; i < beams; ++i)
      sensor.bearings_rad.push_back(static_cast<float>(2.0 * std::numbers::pi * (1.0 * i / beams - 0.5)));
    scan.ranges_m.assign(beams, 4.0F);
  }
  [[nodiscard]] std::vector<float> rest() const { return without_mixed_pixels(scan, sensor).ranges_m; }

  static constexpr int beams = 360;
  slam::Sensor sensor;
  slam::Scan scan;
};

TEST_F(MixedPixels, BetweenAnEdgeAndWhatIsBehindItGo) {
  for (int i = 100; i < 120; ++i) scan.ranges_m[i] = 2.0F;
  scan.ranges_m[120] = 2.9F;
  scan.ranges_m[99] = 3.3F;
  auto expected = scan.ranges_m;
  expected[120] = 0.0F;
  expected[99] = 0.0F;
  EXPECT_EQ(rest(), expected);
}

TEST_F(MixedPixels, WhereTheScannersCircleCloses) {
  for (int i = 300; i < beams; ++i) scan.ranges_m[i] = 2.0F;
  scan.ranges_m[0] = 3.0F;
  EXPECT_EQ(rest()[0], 0.0F);
}

TEST_F(MixedPixels, AreNotThinThingsThatStandBeforeAWall) {
  scan.ranges_m[50] = 2.0F;
  scan.ranges_m[70] = 2.0F;
  scan.ranges_m[71] = 2.1F;
  EXPECT_EQ(rest(), scan.ranges_m);
}

TEST_F(MixedPixels, AreNotWallsThatACorridorShowsVeryAslant) {
  // Walls 1 m to both sides: at 10 m, one beam meets them 1.8 m behind the one beside it.
  for (int i = 0; i < beams; ++i) {
    double const aside = std::abs(std::sin(double{sensor.bearings_rad[i]}));
    scan.ranges_m[i] = static_cast<float>(std::min(10.0, 1.0 / std::max(aside, 0.01)));
  }
  EXPECT_EQ(rest(), scan.ranges_m);
}

TEST_F(MixedPixels, AreNotToldOfBeamsThatAreNoNeighbours) {
  sensor.bearings_rad = {-1.5F, 0.0F, 1.5F, 3.1F};
  scan.ranges_m = {1.0F, 2.0F, 3.0F, 4.0F};
  EXPECT_EQ(rest(), scan.ranges_m);
}

}  // namespace
}  // namespace lapwing::robot
