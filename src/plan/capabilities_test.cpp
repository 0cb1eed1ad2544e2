#include "plan/capabilities.hpp"

#include <gtest/gtest.h>

#include "plan/mission_builder.hpp"

namespace lapwing::plan {
namespace {

using enum mavlink::MavCmd;
using enum vehicle::Family;
using vehicle::Autopilot;
using vehicle::Family;

auto const home = geo::Wgs84::from_degrees(40.0, -8.0, 100.0);

Handling on_ardupilot(Family family, mavlink::MavCmd command) {
  return handling(Autopilot::ardupilot, family, command);
}

TEST(Capabilities, OfArduPilotDependOnWhatMoves) {
  for (auto const family : {copter, plane, vtol, rover, boat, sub}) {
    for (auto const command : {nav_waypoint, nav_loiter_turns, nav_delay, do_jump, do_change_speed, do_set_home})
      EXPECT_EQ(on_ardupilot(family, command), Handling::carried_out) << to_string(family);
    bool const flies = family == copter || family == plane || family == vtol;
    EXPECT_EQ(on_ardupilot(family, nav_takeoff), flies ? Handling::carried_out : Handling::skipped);
    EXPECT_EQ(on_ardupilot(family, nav_land), flies || family == sub ? Handling::carried_out : Handling::skipped);
  }
  EXPECT_EQ(on_ardupilot(plane, nav_continue_and_change_alt), Handling::carried_out);
  EXPECT_EQ(on_ardupilot(copter, nav_continue_and_change_alt), Handling::skipped);
  EXPECT_EQ(on_ardupilot(rover, do_set_reverse), Handling::carried_out);
  EXPECT_EQ(on_ardupilot(copter, nav_spline_waypoint), Handling::carried_out);
  EXPECT_EQ(on_ardupilot(rover, nav_spline_waypoint), Handling::skipped);
  EXPECT_EQ(on_ardupilot(plane, nav_spline_waypoint), Handling::refused);
}

TEST(Capabilities, OfPx4ExcludeCirclesAndLaterHomes) {
  EXPECT_EQ(handling(Autopilot::px4, copter, nav_loiter_time), Handling::carried_out);
  EXPECT_EQ(handling(Autopilot::px4, copter, nav_loiter_turns), Handling::refused);
  EXPECT_EQ(handling(Autopilot::px4, copter, do_set_home), Handling::refused);
}

TEST(Capabilities, OfOtherVehiclesAreLeftToTheUpload) {
  EXPECT_EQ(handling(Autopilot::other, rover, nav_takeoff), Handling::unknown);
  EXPECT_EQ(on_ardupilot(unknown, nav_takeoff), Handling::unknown);
  EXPECT_EQ(on_ardupilot(copter, static_cast<mavlink::MavCmd>(31000)), Handling::unknown);
}

TEST(Capabilities, TypesOfVehiclesAreFamilies) {
  EXPECT_EQ(families_of("UAV"), (std::vector{copter, plane, vtol}));
  EXPECT_EQ(families_of("UGV"), std::vector{rover});
  EXPECT_EQ(families_of("USV"), std::vector{boat});
  EXPECT_EQ(families_of("UUV"), std::vector{sub});
  EXPECT_TRUE(families_of("XXX").empty());
}

TEST(Objection, NamesItemCommandAndVehicle) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(home));
  ASSERT_TRUE(builder.take_off(home, 15.0));
  auto const mission = *builder.finish("m");
  auto const items = for_autopilot(mission, Autopilot::ardupilot, home, rover);
  auto const error = objection(items, Autopilot::ardupilot, rover);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->message, "item 2, NAV_TAKEOFF: a rover with ArduPilot would skip it");
  EXPECT_EQ(error->hint, "leave out the take-off");
  EXPECT_FALSE(objection(items, Autopilot::ardupilot, copter));
  EXPECT_FALSE(objection(items, Autopilot::ardupilot, unknown));
}

TEST(Objection, ToCirclesOnPx4SaysThatItRefuses) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.loiter(home, {.kind = Loiter::Kind::turns, .amount = 2}));
  auto const items = for_autopilot(*builder.finish("m"), Autopilot::px4, home, copter);
  EXPECT_EQ(objection(items, Autopilot::px4, copter)->message,
            "item 0, NAV_LOITER_TURNS: a copter with PX4 refuses it");
}

}  // namespace
}  // namespace lapwing::plan
