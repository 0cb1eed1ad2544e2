#include "scans/scan_reader.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::scans {
namespace {

constexpr float quarter = std::numbers::pi_v<float> / 2.0F;

bus::LaserScan a_scan(std::vector<float> ranges) {
  return {.angle_min = -quarter,
          .angle_increment = quarter,
          .range_min = 0.1F,
          .range_max = 12.0F,
          .ranges = std::move(ranges)};
}

TEST(ScanReader, KnowsWhereTheBeamsLook) {
  auto const reader = ScanReader::make(a_scan({1.0F, 2.0F, 3.0F}), {.pose = {0.2, 0.1, 0.0}});
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->sensor().bearings_rad, (std::vector<float>{-quarter, 0.0F, quarter}));
  EXPECT_EQ(reader->sensor().mount_m, Eigen::Vector2f(0.2F, 0.1F));
}

TEST(ScanReader, TurnsRoundWhatHangsUpsideDown) {
  auto const reader = ScanReader::make(a_scan({1.0F, 2.0F, 3.0F}), {.pose = {}, .is_upside_down = true});
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->sensor().bearings_rad, (std::vector<float>{-quarter, 0.0F, quarter})) << "ascending all the same";
  EXPECT_EQ(*reader->ranges(a_scan({1.0F, 2.0F, 3.0F})), (std::vector<float>{3.0F, 2.0F, 1.0F}));
}

TEST(ScanReader, TakesWhatIsNoRangeForNothingMeasured) {
  auto const reader = ScanReader::make(a_scan({1.0F, 2.0F, 3.0F}), {});
  auto const infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(*reader->ranges(a_scan({std::nanf(""), 0.05F, infinity})), (std::vector<float>{0.0F, 0.0F, 12.0F}));
  EXPECT_FALSE(reader->ranges(a_scan({1.0F}))) << "another laser's";
}

TEST(ScanReader, RefusesWhatNoLaserSends) {
  EXPECT_FALSE(ScanReader::make(a_scan({}), {}));
  auto scan = a_scan({1.0F});
  scan.angle_increment = 0.0F;
  EXPECT_FALSE(ScanReader::make(scan, {}));
  scan.angle_increment = std::nanf("");
  EXPECT_FALSE(ScanReader::make(scan, {}));
  scan = a_scan({1.0F});
  scan.range_max = -1.0F;
  EXPECT_FALSE(ScanReader::make(scan, {}));
}

}  // namespace
}  // namespace lapwing::scans
