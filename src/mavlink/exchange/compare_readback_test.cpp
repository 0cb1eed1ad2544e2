#include <gtest/gtest.h>

#include <limits>

#include "mavlink/testing/mission_store.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

MissionItem item(MavCmd command, std::array<float, 4> params = {}, MavFrame frame = MavFrame::global) {
  MissionItem result;
  result.command = command;
  result.params = params;
  result.frame = frame;
  result.place = {.lat_rad = 0.7, .lon_rad = -0.1, .z_m = 12.345};
  return result;
}

std::vector<Difference> compared(MissionItem const& sent, MissionItem const& got, MavAutopilot autopilot) {
  std::vector const a{item(MavCmd::nav_waypoint), sent};
  std::vector const b{item(MavCmd::nav_waypoint), got};
  return compare_readback(a, b, autopilot);
}

TEST(CompareReadback, ForgivesWhatArduPilotNormalises) {
  auto constexpr nan = std::numeric_limits<float>::quiet_NaN();
  auto const ardupilot = MavAutopilot::ardupilotmega;
  auto got = item(MavCmd::nav_waypoint, {2, 0, 0, 0}, MavFrame::global_relative_alt);
  got.place.z_m = 12.34;
  got.autocontinue = true;
  EXPECT_TRUE(
      compared(item(MavCmd::nav_waypoint, {2.7F, 50, 0, nan}, MavFrame::global_relative_alt_int), got, ardupilot)
          .empty());
  EXPECT_TRUE(compared(item(MavCmd::nav_loiter_turns, {2.5F, 0, 15, 0}), item(MavCmd::nav_loiter_turns, {2, 0, 15, 0}),
                       ardupilot)
                  .empty());
  EXPECT_TRUE(
      compared(item(MavCmd::nav_loiter_time, {30, 0, 50, 0}), item(MavCmd::nav_loiter_time, {30, 0, 1, 0}), ardupilot)
          .empty());
  EXPECT_TRUE(
      compared(item(MavCmd::nav_land, {0, 0, 0, nan}), item(MavCmd::nav_land, {0, 0, 0, 1}), ardupilot).empty());
  auto speed = item(MavCmd::do_change_speed, {0, 8.5F, -1, 0}, MavFrame::global_relative_alt);
  auto stored = speed;
  stored.frame = MavFrame::global;
  stored.place = {};
  EXPECT_TRUE(compared(speed, stored, ardupilot).empty());
}

/// As its 4.7 returns them.
TEST(CompareReadback, ForgivesWhatArduPilotDropsOfFencesAndRallyPoints) {
  auto const ardupilot = MavAutopilot::ardupilotmega;
  auto sent = item(MavCmd::nav_fence_return_point, {}, MavFrame::global_relative_alt);
  sent.type = MissionType::fence;
  auto got = sent;
  got.frame = MavFrame::global;
  got.place.z_m = 0.0;
  EXPECT_TRUE(compared(sent, got, ardupilot).empty());
  EXPECT_EQ(compared(sent, got, MavAutopilot::px4), std::vector<Difference>{"item 1: frame 0, sent 3"});
  got.place.lat_rad += 1e-6;
  EXPECT_EQ(compared(sent, got, ardupilot).size(), 1u);

  auto rally = item(MavCmd::nav_rally_point, {}, MavFrame::global_relative_alt);
  rally.type = MissionType::rally;
  auto cut = rally;
  cut.place.z_m = 12.0;
  EXPECT_TRUE(compared(rally, cut, ardupilot).empty());
  cut.place.z_m = 11.0;
  EXPECT_EQ(compared(rally, cut, ardupilot), std::vector<Difference>{"item 1: altitude 11.00 m, sent 12.35 m"});
}

TEST(CompareReadback, LeavesHomeToArduPilotOnly) {
  std::vector<MissionItem> const sent{item(MavCmd::nav_waypoint)};
  auto moved = sent;
  moved[0].place.lat_rad += 0.01;
  EXPECT_TRUE(compare_readback(sent, moved, MavAutopilot::ardupilotmega).empty());
  EXPECT_FALSE(compare_readback(sent, moved, MavAutopilot::px4).empty());
}

TEST(CompareReadback, SaysWhatDiffers) {
  auto const sent = item(MavCmd::nav_waypoint);
  auto const ardupilot = MavAutopilot::ardupilotmega;
  auto higher = sent;
  higher.place.z_m = 40;
  EXPECT_EQ(compared(sent, higher, ardupilot), std::vector<Difference>{"item 1: altitude 40.00 m, sent 12.35 m"});
  auto moved = sent;
  moved.place.lon_rad += 1e-6;
  ASSERT_EQ(compared(sent, moved, ardupilot).size(), 1u);
  EXPECT_EQ(compared(sent, moved, ardupilot)[0].rfind("item 1: position", 0), 0u);
  EXPECT_EQ(compared(sent, item(MavCmd::nav_land), ardupilot),
            std::vector<Difference>{"item 1: command NAV_LAND, sent NAV_WAYPOINT"});
  auto relative = sent;
  relative.frame = MavFrame::global_relative_alt;
  EXPECT_EQ(compared(sent, relative, ardupilot), std::vector<Difference>{"item 1: frame 3, sent 0"});
  EXPECT_EQ(
      compared(item(MavCmd::do_change_speed, {0, 8, -1, 0}), item(MavCmd::do_change_speed, {0, 3, -1, 0}), ardupilot),
      std::vector<Difference>{"item 1: parameter 2 of DO_CHANGE_SPEED is 3, sent 8"});
  EXPECT_EQ(compare_readback(mission_of(3), mission_of(2), ardupilot),
            std::vector<Difference>{"the vehicle holds 2 items, sent 3"});
}

}  // namespace
}  // namespace lapwing::mavlink
