#include "plan/mission.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "plan/mission_builder.hpp"

namespace lapwing::plan {
namespace {

using geo::Wgs84;
using mavlink::MavCmd;
using vehicle::Autopilot;

auto const home = Wgs84::from_degrees(40.0, -8.0, 100.0);

Mission finished(MissionBuilder const& builder) {
  auto mission = builder.finish("m");
  EXPECT_TRUE(mission) << mission.error().message;
  return *mission;
}

TEST(Mission, HomeComesFirstOnArduPilotAlone) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.home(home));
  ASSERT_TRUE(builder.waypoint(Wgs84::from_degrees(41, -8)));
  auto const mission = finished(builder);
  EXPECT_EQ(mission.home, home);
  auto const items = for_autopilot(mission, Autopilot::ardupilot, Wgs84{});
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(items[0].command, MavCmd::nav_waypoint);
  EXPECT_EQ(position_of(items[0]), home);
  EXPECT_EQ(items[1].seq, 1);
  EXPECT_EQ(for_autopilot(mission, Autopilot::px4, Wgs84{}).size(), 1u);
}

TEST(Mission, WithoutAnyKnownHomeStillHasAnItemZeroOnArduPilot) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(home));
  auto const items = for_autopilot(finished(builder), Autopilot::ardupilot, std::nullopt);
  ASSERT_EQ(items.size(), 2u);
  EXPECT_EQ(position_of(items[0]), Wgs84{});
}

TEST(Mission, HomeAfterOtherCommandsStaysAnItemAndMovesRelativeOnes) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(home));
  auto const later = Wgs84::from_degrees(45, 5, 10);
  ASSERT_TRUE(builder.home(later));
  EXPECT_EQ(builder.from_home({}), later);
  EXPECT_EQ(builder.from_last({}), home);
  auto const mission = finished(builder);
  EXPECT_EQ(mission.home, std::nullopt);
  EXPECT_EQ(mission.items[1].command, MavCmd::do_set_home);
}

TEST(Mission, EveryPlaceMovesTheLastPosition) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.home(home));
  auto expect_last = [&](Wgs84 place) { EXPECT_EQ(builder.from_last({}), place); };
  expect_last(home);
  auto const place = [](double lat_deg) { return Wgs84::from_degrees(lat_deg, 1.0, 50.0); };
  ASSERT_TRUE(builder.take_off(place(1), 15.0));
  expect_last(place(1));
  ASSERT_TRUE(builder.loiter(place(2), {}));
  expect_last(place(2));
  ASSERT_TRUE(builder.land(place(3), MissionBuilder::free_yaw, 0));
  expect_last(place(3));
  ASSERT_TRUE(builder.survey({.base = place(4), .length_m = 100, .width_m = 100}));
  expect_last(place(4));
}

TEST(Mission, RefusedCommandLeavesEverythingAsItWas) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.home(home));
  EXPECT_FALSE(builder.waypoint(Wgs84::from_degrees(99, 0)));
  EXPECT_FALSE(builder.survey({.base = Wgs84::from_degrees(99, 0), .length_m = 1, .width_m = 1}));
  EXPECT_EQ(builder.from_last({}), home);
  EXPECT_TRUE(finished(builder).items.empty());
}

TEST(Mission, ChangeOfAltitudeIsWhatTheAutopilotKnows) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.home(home));
  ASSERT_TRUE(builder.take_off(Wgs84::from_degrees(40, -8, 150), 15.0));
  ASSERT_TRUE(builder.change_altitude(120.0));
  ASSERT_TRUE(builder.change_altitude(130.0));
  EXPECT_EQ(builder.from_last({.up_m = 5.0})->alt_m, 135.0);
  auto const mission = finished(builder);
  auto const ardupilot = for_autopilot(mission, Autopilot::ardupilot, std::nullopt);
  EXPECT_EQ(ardupilot[2].command, MavCmd::nav_continue_and_change_alt);
  EXPECT_EQ(ardupilot[2].params[0], 2.0F);  // descend
  EXPECT_EQ(ardupilot[2].place.z_m, 120.0);
  EXPECT_EQ(ardupilot[3].params[0], 1.0F);  // climb
}

TEST(Mission, ChangeOfAltitudeIsAWaypointAboveTheLastPlaceWhereNothingElseIsFlown) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.home(home));
  ASSERT_TRUE(builder.take_off(Wgs84::from_degrees(40.1, -8, 150), 15.0));
  ASSERT_TRUE(builder.change_altitude(120.0));
  auto const mission = finished(builder);
  auto const above = Wgs84::from_degrees(40.1, -8, 120);
  for (auto const& items : {for_autopilot(mission, Autopilot::ardupilot, std::nullopt, vehicle::Family::copter),
                            for_autopilot(mission, Autopilot::px4, std::nullopt, vehicle::Family::plane)}) {
    EXPECT_EQ(items.back().command, MavCmd::nav_waypoint);
    EXPECT_EQ(position_of(items.back()), above);
  }
}

TEST(Mission, ChangeOfAltitudeWithoutAnEarlierPlaceIsAboveTheCopter) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.change_altitude(120.0));
  auto const copter =
      for_autopilot(finished(builder), Autopilot::ardupilot, std::nullopt, vehicle::Family::copter).back();
  EXPECT_EQ(copter.command, MavCmd::nav_waypoint);
  EXPECT_EQ(position_of(copter), (Wgs84{0.0, 0.0, 120.0}));
  EXPECT_EQ(for_autopilot(finished(builder), Autopilot::px4, std::nullopt).back().command, MavCmd::do_change_altitude);
}

TEST(Mission, ChangeOfAltitudeCountsFromWhatItsSecondParameterSays) {
  auto constexpr global = mavlink::MavFrame::global;
  auto constexpr above_home = mavlink::MavFrame::global_relative_alt;
  Mission mission{.name = "file", .home = std::nullopt, .items = {}};
  mission.items.push_back({.frame = above_home, .command = MavCmd::nav_waypoint});
  mission.items.back().place = {.lat_rad = home.lat_rad, .lon_rad = home.lon_rad, .z_m = 30.0};
  mission.items.push_back({.command = MavCmd::do_change_altitude, .params = {50.0F, 3.0F}});
  auto const last_on = [&](Autopilot autopilot, vehicle::Family family) {
    return for_autopilot(mission, autopilot, home, family).back();
  };
  for (auto const& item :
       {last_on(Autopilot::ardupilot, vehicle::Family::copter), last_on(Autopilot::px4, vehicle::Family::copter)}) {
    EXPECT_EQ(item.command, MavCmd::nav_waypoint);
    EXPECT_EQ(item.frame, above_home);
    EXPECT_EQ(item.place.z_m, 50.0);
  }
  auto const plane = last_on(Autopilot::ardupilot, vehicle::Family::plane);
  EXPECT_EQ(plane.frame, above_home);
  EXPECT_EQ(plane.params[0], 1.0F) << "climbs from 30 m above home";
  mission.items.back().params[1] = 0.0F;
  EXPECT_EQ(last_on(Autopilot::ardupilot, vehicle::Family::copter).frame, global);
  EXPECT_EQ(last_on(Autopilot::ardupilot, vehicle::Family::plane).params[0], 0.0F) << "from an unknown height";
  for (float const local : {1.0F, -1.0F, 300.0F, std::nanf("")}) {
    mission.items.back().params[1] = local;
    EXPECT_EQ(last_on(Autopilot::ardupilot, vehicle::Family::copter).command, MavCmd::do_change_altitude) << local;
  }
}

TEST(Mission, ItemsWithoutAPlaceHaveNoFrameOnPx4) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(home));
  ASSERT_TRUE(builder.change_speed(5.0, 0));
  auto const mission = finished(builder);
  auto const px4 = for_autopilot(mission, Autopilot::px4, home);
  EXPECT_EQ(px4[0].frame, mavlink::MavFrame::global);
  EXPECT_EQ(px4[1].frame, mavlink::MavFrame::mission);
  EXPECT_EQ(for_autopilot(mission, Autopilot::ardupilot, home)[2].frame, mavlink::MavFrame::global);
}

TEST(Mission, ChangeOfAltitudeFromAnUnknownOneLeavesTheWayOpen) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.change_altitude(120.0));
  EXPECT_EQ(for_autopilot(finished(builder), Autopilot::ardupilot, std::nullopt)[1].params[0], 0.0F);
}

TEST(Mission, JumpsMeanTheSameItemOnEveryAutopilot) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(home));
  ASSERT_TRUE(builder.jump(1, 2));
  auto const mission = finished(builder);
  EXPECT_EQ(for_autopilot(mission, Autopilot::ardupilot, home)[2].params[0], 1.0F);
  EXPECT_EQ(for_autopilot(mission, Autopilot::px4, home)[1].params[0], 0.0F);
}

TEST(Mission, JumpsMayLeadAheadButNotBeyondTheEnd) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.jump(2, 1));
  EXPECT_FALSE(builder.finish("m"));
  ASSERT_TRUE(builder.waypoint(home));
  EXPECT_TRUE(builder.finish("m"));
}

TEST(Mission, PhotosAreNumberedFromOne) {
  MissionBuilder builder;
  EXPECT_FALSE(takes_photos(finished(builder)));
  ASSERT_TRUE(builder.capture_photo());
  ASSERT_TRUE(builder.capture_photo());
  auto const mission = finished(builder);
  EXPECT_EQ(mission.items[0].params[3], 1.0F);
  EXPECT_EQ(mission.items[1].params[3], 2.0F);
  EXPECT_TRUE(takes_photos(mission));
}

TEST(Mission, HoldsNoMoreItemsThanCanBeCounted) {
  MissionBuilder builder;
  for (std::size_t i = 0; i + 1 < max_mission_items; ++i) ASSERT_TRUE(builder.stop_capture());
  auto const refused = builder.stop_capture();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "a mission can hold at most 65535 items");
  EXPECT_FALSE(builder.survey({.base = home, .length_m = 100, .width_m = 100}));
  EXPECT_EQ(for_autopilot(finished(builder), Autopilot::ardupilot, home).size(), max_mission_items);
}

TEST(Mission, SurveyTooLargeForAMissionIsRefused) {
  MissionBuilder builder;
  auto const refused = builder.survey({.base = home, .length_m = 100, .width_m = 1e6, .spacing_m = 1.0});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, base::ErrorKind::invalid_input);
}

}  // namespace
}  // namespace lapwing::plan
