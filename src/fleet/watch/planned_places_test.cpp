#include "fleet/watch/planned_places.hpp"

#include <gtest/gtest.h>

namespace lapwing::fleet {
namespace {

using mavlink::MavCmd;
using vehicle::Autopilot;
using vehicle::Family;

mavlink::MissionItem item(MavCmd command, float first = 0.0F, float second = 0.0F, float third = 0.0F) {
  mavlink::MissionItem made;
  made.command = command;
  made.params = {first, second, third, 0.0F};
  made.place = {.lat_rad = 0.7, .lon_rad = -0.1, .z_m = 100.0};
  return made;
}

std::vector<PlannedPlace> places_of(std::vector<mavlink::MissionItem> const& items, Family family = Family::copter,
                                    Autopilot autopilot = Autopilot::ardupilot) {
  return planned_places(items, 1, autopilot, family);
}

std::vector<int> seqs(std::vector<PlannedPlace> const& places) {
  std::vector<int> numbers;
  for (auto const& place : places) numbers.push_back(place.seq);
  return numbers;
}

auto const home = item(MavCmd::nav_waypoint);

TEST(PlannedPlaces, AreWhereItGoesAndNotWhereItTakesOff) {
  auto const places = places_of({home, item(MavCmd::nav_takeoff), item(MavCmd::nav_waypoint), item(MavCmd::nav_delay),
                                 item(MavCmd::do_change_speed), item(MavCmd::nav_land)});
  EXPECT_EQ(seqs(places), (std::vector{2, 5}));
}

TEST(PlannedPlaces, LeaveOutWhatSaysHereAndWhatHasNoPlaceOnEarth) {
  auto here = item(MavCmd::nav_waypoint);
  here.place = {.lat_rad = 0.0, .lon_rad = 0.0, .z_m = 120.0};
  auto local = item(MavCmd::nav_waypoint);
  local.frame = mavlink::MavFrame::local_ned;
  EXPECT_EQ(seqs(places_of({home, here, local, item(MavCmd::nav_waypoint)})), std::vector{3});
}

TEST(PlannedPlaces, FollowJumps) {
  auto const point = item(MavCmd::nav_waypoint);
  EXPECT_EQ(seqs(places_of({home, point, item(MavCmd::do_jump, 1, 2), point})), (std::vector{1, 3}));
  EXPECT_EQ(seqs(places_of({home, point, item(MavCmd::do_jump, 1, -1), point})), std::vector{1});
  EXPECT_EQ(seqs(places_of({home, item(MavCmd::do_jump, 3, -1), point, point})), std::vector{3});
  EXPECT_EQ(seqs(places_of({home, item(MavCmd::do_jump, 3, 0), point, point})), (std::vector{2, 3}));
  EXPECT_EQ(seqs(places_of({home, item(MavCmd::do_jump_tag, 7, -1), point, item(MavCmd::jump_tag, 7), point})),
            std::vector{4});
}

TEST(PlannedPlaces, EndAtAnUnlimitedLoiter) {
  auto const places = places_of({home, item(MavCmd::nav_loiter_unlim), item(MavCmd::nav_waypoint)});
  EXPECT_EQ(seqs(places), std::vector{1});
}

TEST(PlannedPlaces, AreWideForWingsAndForWhatAnItemItselfAccepts) {
  auto const point = item(MavCmd::nav_waypoint, 0, 50);
  EXPECT_EQ(places_of({home, point}).front().radius_m, 20.0);  // ArduPilot's copters do not look at the 50
  EXPECT_EQ(places_of({home, point}, Family::copter, Autopilot::px4).front().radius_m, 70.0);
  EXPECT_EQ(places_of({home, point}, Family::plane).front().radius_m, 300.0);
}

TEST(PlannedPlaces, AreAsWideAsTheirCircles) {
  EXPECT_EQ(places_of({home, item(MavCmd::nav_loiter_turns, 3, 0, -80)}).front().radius_m, 100.0);
  EXPECT_EQ(places_of({home, item(MavCmd::nav_loiter_turns, 3)}).front().radius_m, 220.0);
  EXPECT_EQ(places_of({home, item(MavCmd::nav_loiter_time, 30, 0, 80)}).front().radius_m, 20.0);  // it stands still
  EXPECT_EQ(places_of({home, item(MavCmd::nav_loiter_time, 30, 0, 80)}, Family::plane).front().radius_m, 330.0);
}

}  // namespace
}  // namespace lapwing::fleet
