#include "parameters/comparison.hpp"

#include <gtest/gtest.h>

namespace lapwing::parameters {
namespace {

using enum mavlink::MavParamType;

TEST(Differences, AreWhatAVehicleWouldHoldOtherwise) {
  std::vector<Parameter> const vehicle{{"C", static_cast<double>(0.1F), real32}, {"A", 1, int8}, {"D", 4, int8}};
  std::vector<Parameter> const file{{"A", 2, real32}, {"C", 0.1, real32}, {"E", 5, real32}};
  auto const found = differences(vehicle, file);
  ASSERT_EQ(found.size(), 3u) << "0.1 is what the float is called";
  EXPECT_EQ(found[0], (Difference{"A", Parameter{"A", 1, int8}, Parameter{"A", 2, real32}}));
  EXPECT_EQ(found[1], (Difference{"D", Parameter{"D", 4, int8}, std::nullopt}));
  EXPECT_EQ(found[2], (Difference{"E", std::nullopt, Parameter{"E", 5, real32}}));
  EXPECT_TRUE(differences(file, file).empty());
}

TEST(Patterns, FitNamesLikeFileNames) {
  EXPECT_TRUE(fits("WPNAV_SPEED", "WPNAV_*"));
  EXPECT_TRUE(fits("WPNAV_SPEED", "wpnav_speed"));
  EXPECT_TRUE(fits("BATT2_MONITOR", "BATT?_*"));
  EXPECT_TRUE(fits("INS_ACC2OFFS_X", "INS_ACC*OFFS_?"));
  EXPECT_TRUE(fits("AAB", "*AB"));
  EXPECT_FALSE(fits("WPNAV_SPEED", "WPNAV"));
  EXPECT_FALSE(fits("BATT_MONITOR", "BATT?_*"));
  EXPECT_FALSE(fits("", "?"));
  EXPECT_TRUE(fits("", "**"));
  EXPECT_TRUE(fits_any("X", {}));
  EXPECT_FALSE(fits_any("X", std::vector<std::string>{"A*", "B*"}));
}

TEST(OneVehicle, OwnsItsIdCalibrationAndCounters) {
  for (auto const* name :
       {"SYSID_THISMAV", "MAV_SYSID", "MAV_SYS_ID", "INS_ACCOFFS_X", "INS_ACC2SCAL_Z", "INS_GYROFFS_Y",
        "INS_GYR3OFFS_X", "COMPASS_OFS_X", "COMPASS_OFS2_Z", "COMPASS_DIA3_Y", "COMPASS_DEV_ID2", "STAT_RUNTIME",
        "AHRS_TRIM_X", "BARO1_GND_PRESS", "CAL_ACC0_XOFF", "MIS_TOTAL"})
    EXPECT_TRUE(belongs_to_one_vehicle(name)) << name;
  for (auto const* name : {"RTL_ALT", "INS_GYRO_FILTER", "COMPASS_USE", "BATT_CAPACITY", "FENCE_RADIUS", "SYSID_MYGCS"})
    EXPECT_FALSE(belongs_to_one_vehicle(name)) << name;
}

}  // namespace
}  // namespace lapwing::parameters
