#include "sim/model/vehicle_spec.hpp"

#include <gtest/gtest.h>

namespace lapwing::sim {
namespace {

using vehicle::Family;

TEST(VehicleSpec, ReadsKindsCountsAndBatteryLevels) {
  auto const groups = parse_vehicles("copter:2, rover:1,plane,copter:3@80%");
  ASSERT_TRUE(groups);
  ASSERT_EQ(groups->size(), 4u);
  EXPECT_EQ((*groups)[0], (VehicleGroup{Family::copter, 2, 1.0}));
  EXPECT_EQ((*groups)[1], (VehicleGroup{Family::rover, 1, 1.0}));
  EXPECT_EQ((*groups)[2], (VehicleGroup{Family::plane, 1, 1.0}));
  EXPECT_EQ((*groups)[3], (VehicleGroup{Family::copter, 3, 0.8}));
}

TEST(VehicleSpec, ReadsTheAutopilot) {
  auto const groups = parse_vehicles("px4:2@50%,px4-plane,copter");
  ASSERT_TRUE(groups);
  EXPECT_EQ((*groups)[0], (VehicleGroup{Family::copter, 2, 0.5, vehicle::Autopilot::px4}));
  EXPECT_EQ((*groups)[1], (VehicleGroup{Family::plane, 1, 1.0, vehicle::Autopilot::px4}));
  EXPECT_EQ((*groups)[2].firmware, vehicle::Autopilot::ardupilot);
}

std::string problem(std::string_view text) {
  auto const groups = parse_vehicles(text);
  if (groups) return "none";
  EXPECT_EQ(groups.error().kind, base::ErrorKind::invalid_input);
  EXPECT_FALSE(groups.error().hint.empty());
  return groups.error().message;
}

TEST(VehicleSpec, NamesWhatIsWrong) {
  EXPECT_EQ(problem("zeppelin:1"), "'zeppelin' is no kind of vehicle that can be simulated");
  EXPECT_EQ(problem("px4plane"), "'px4plane' is no kind of vehicle that can be simulated");
  EXPECT_EQ(problem("px4-sub"), "'px4-sub' is no kind of vehicle that can be simulated");
  EXPECT_EQ(problem("copter:many"), "'many' is no number of vehicles from 1 to 250");
  EXPECT_EQ(problem("copter:0"), "'0' is no number of vehicles from 1 to 250");
  EXPECT_EQ(problem(""), "no vehicle is named in ''");
  EXPECT_EQ(problem("copter:1,"), "no vehicle is named in 'copter:1,'");
  EXPECT_EQ(problem("copter@120%"), "'120%' is no battery level");
  EXPECT_EQ(problem("copter:200,rover:100"), "300 vehicles are more than one MAVLink network holds");
}

}  // namespace
}  // namespace lapwing::sim
