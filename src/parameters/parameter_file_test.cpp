#include "parameters/parameter_file.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::parameters {
namespace {

using enum mavlink::MavParamType;

std::string complaint(std::string_view text) {
  auto const file = read_parameter_file("a.params", text);
  EXPECT_FALSE(file) << text;
  return file ? "" : file.error().message;
}

TEST(ParameterFile, ReadsWhatQgroundcontrolWrites) {
  auto const file = read_parameter_file("a.params",
                                        "# Onboard parameters for Vehicle 1\n#\n# Stack: ArduPilot\n"
                                        "# Vehicle-Id Component-Id Name Value Type\n"
                                        "1\t1\tACRO_BAL_PITCH\t1.000000000000000000\t9\n"
                                        "1\t1\tRTL_ALT\t1500\t6\r\n"
                                        "1\t154\tGMB_MODE\t2\t6\n");
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->has_types);
  ASSERT_EQ(file->parameters.size(), 2u);
  EXPECT_EQ(file->parameters[0], (Parameter{"ACRO_BAL_PITCH", 1, real32}));
  EXPECT_EQ(file->parameters[1], (Parameter{"RTL_ALT", 1500, int32}));
  EXPECT_EQ(file->of_other_components, 1u);
}

TEST(ParameterFile, ReadsWhatMissionPlannerAndMavproxyWrite) {
  auto const file = read_parameter_file("a.param",
                                        "\xEF\xBB\xBF#NOTE: 21/11/2026\nRTL_ALT,1500\nWPNAV_SPEED 1000 # cm/s\n"
                                        "STAT_RESET,-1.5e-3,@READONLY\n\n");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_FALSE(file->has_types);
  ASSERT_EQ(file->parameters.size(), 3u);
  EXPECT_EQ(file->parameters[1], (Parameter{"WPNAV_SPEED", 1000, real32}));
  EXPECT_EQ(file->parameters[2].value, -1.5e-3);
}

TEST(ParameterFile, SaysWhereItIsWrong) {
  EXPECT_EQ(complaint("RTL_ALT,1500\nRTL_ALT;3\n"),
            "a.params:2: expected NAME,VALUE, or vehicle id, component id, name, value, type");
  EXPECT_EQ(complaint("RTL_ALT,high\n"), "a.params:1: 'high' is no number");
  EXPECT_EQ(complaint("A_NAME_THAT_IS_TOO_LONG,1"),
            "a.params:1: 'A_NAME_THAT_IS_TOO_LONG' is no parameter's name (1 to 16 characters)");
  EXPECT_EQ(complaint("1\t1\tRTL_ALT\t1500\t11\n"), "a.params:1: 11 is no type of parameters (1 to 10)");
  EXPECT_EQ(complaint("1\tx\tRTL_ALT\t1500\t6\n"), "a.params:1: expected vehicle id, component id, name, value, type");
  EXPECT_EQ(complaint("A,1\nB,2\nA,3\n"), "a.params:3: A was 1 before: which is right?");
  EXPECT_EQ(complaint("# nothing\n"), "a.params: there are no parameters in it");
}

TEST(ParameterFile, TakesANameThatSaysTheSameTwice) {
  auto const file = read_parameter_file("a", "A,1\nA,1.0\n");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->parameters.size(), 1u);
}

TEST(ParameterFile, KeepsEveryValueThatItWrites) {
  std::mt19937 random(1);
  std::vector<Parameter> all{{"INF", std::numeric_limits<double>::infinity(), real32},
                             {"LARGE", 4294967295.0, uint32},
                             {"SMALL", -2147483648.0, int32},
                             {"TINY", static_cast<double>(std::numeric_limits<float>::denorm_min()), real32}};
  for (int i = 0; i < 1000; ++i)
    all.push_back(
        {"P" + std::to_string(i), static_cast<double>(std::ldexp(static_cast<float>(random()), -(i % 60))), real32});
  auto const qgc = read_parameter_file("a", qgroundcontrol_text(all, {.system_id = 7, .stack = "ArduPilot"}));
  ASSERT_TRUE(qgc) << qgc.error().message;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(qgc->parameters[i].type, all[i].type);
    EXPECT_TRUE(same_value(qgc->parameters[i], all[i])) << all[i].name;
  }
  auto const mp = read_parameter_file("a", mission_planner_text(all));
  ASSERT_TRUE(mp);
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_TRUE(same_value(mp->parameters[i], all[i])) << all[i].name;
}

TEST(ParameterFile, RefusesAFileThatNoVehicleCanHave) {
  std::string text;
  for (std::size_t i = 0; i <= max_file_parameters; ++i) text += "P" + std::to_string(i) + ",1\n";
  EXPECT_EQ(complaint(text), "a.params:20001: more than 20000 parameters");
}

}  // namespace
}  // namespace lapwing::parameters
