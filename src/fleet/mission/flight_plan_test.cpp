#include "fleet/mission/flight_plan.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using mavlink::MavCmd;

mavlink::MissionItem item(MavCmd command, float param1 = 0.0F) {
  mavlink::MissionItem made;
  made.command = command;
  made.params[0] = param1;
  made.place = {.lat_rad = 0.7, .lon_rad = -0.1, .z_m = 100.0};
  return made;
}

FlightPlan planned(std::vector<mavlink::MissionItem> items,
                   vehicle::Autopilot autopilot = vehicle::Autopilot::ardupilot,
                   vehicle::Family family = vehicle::Family::unknown) {
  vehicle::VehicleState vehicle;
  vehicle.autopilot = autopilot;
  vehicle.family = family;
  return flight_plan(plan::Mission{.name = "m", .home = std::nullopt, .items = std::move(items)}, vehicle);
}

TEST(FlightPlan, BeginsAfterTheHomeItemOnArduPilotOnly) {
  auto const ardupilot = planned({item(MavCmd::nav_waypoint)});
  EXPECT_EQ(ardupilot.items.size(), 2u);
  EXPECT_EQ(ardupilot.first_seq, 1);
  auto const px4 = planned({item(MavCmd::nav_waypoint)}, vehicle::Autopilot::px4);
  EXPECT_EQ(px4.items.size(), 1u);
  EXPECT_EQ(px4.first_seq, 0);
}

TEST(FlightPlan, EndsAtTheLastNavigationItem) {
  auto const plan = planned({item(MavCmd::nav_takeoff), item(MavCmd::nav_waypoint), item(MavCmd::do_change_speed)});
  EXPECT_EQ(plan.shape.last_nav_seq, 2);
  EXPECT_EQ(plan.shape.ending, MissionEnding::at_place);
}

TEST(FlightPlan, KnowsHowTheLastItemEnds) {
  EXPECT_EQ(planned({item(MavCmd::nav_land)}).shape.ending, MissionEnding::on_ground);
  EXPECT_EQ(planned({item(MavCmd::nav_return_to_launch)}).shape.ending, MissionEnding::on_ground);
  EXPECT_EQ(planned({item(MavCmd::nav_loiter_unlim)}).shape.ending, MissionEnding::never);
  EXPECT_EQ(planned({item(MavCmd::nav_delay)}).shape.ending, MissionEnding::at_place);
}

TEST(FlightPlan, EndsOnAPlaneWhereItSaysReturn) {
  auto const items = {item(MavCmd::nav_waypoint), item(MavCmd::nav_return_to_launch), item(MavCmd::nav_waypoint)};
  EXPECT_EQ(planned(items, vehicle::Autopilot::ardupilot, vehicle::Family::plane).shape.last_nav_seq, 2);
  EXPECT_EQ(planned(items, vehicle::Autopilot::ardupilot, vehicle::Family::copter).shape.last_nav_seq, 3);
  EXPECT_EQ(planned(items, vehicle::Autopilot::px4, vehicle::Family::plane).shape.last_nav_seq, 2);  // counted from 0
}

TEST(FlightPlan, LeavesTheEndOfALoopToTheAutopilot) {
  auto const plan = planned({item(MavCmd::nav_waypoint), item(MavCmd::nav_waypoint), item(MavCmd::do_jump, 1.0F)});
  EXPECT_EQ(plan.shape.ending, MissionEnding::never);
}

TEST(FlightPlan, DrawsOnlyPlacesToFlyTo) {
  auto const plan = planned({item(MavCmd::do_set_home), item(MavCmd::nav_takeoff), item(MavCmd::do_change_speed),
                             item(MavCmd::nav_waypoint)});
  EXPECT_EQ(plan.path.size(), 2u);
}

}  // namespace
}  // namespace lapwing::fleet
