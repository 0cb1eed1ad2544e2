#include "sim/safety/fence.hpp"

#include <gtest/gtest.h>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

/// Besides, switches off what keeps guided flight inside, so that fences can be breached.
void set(TestGround& ground, std::initializer_list<std::pair<char const*, float>> parameters) {
  (void)ground.vehicle().parameters().set("AVOID_ENABLE", 0);
  for (auto const& [name, value] : parameters) ground.set(name, value);
}

MissionItem zone_item(TestGround& ground, MavCmd command, double north, double east, float p1) {
  auto const make = ground.maker();
  auto item = make.at(command, {north, east, 0.0}, {p1});
  item.type = MissionType::fence;
  return item;
}

std::vector<MissionItem> square(TestGround& ground, MavCmd command, double north, double east, double half_m) {
  std::vector<MissionItem> items;
  for (auto const& [n, e] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
    items.push_back(zone_item(ground, command, north + n * half_m, east + e * half_m, 4.0F));
  return items;
}

std::optional<MavMissionResult> upload_fence(TestGround& ground, std::vector<MissionItem> const& items) {
  auto const result = ground.upload(items);
  EXPECT_EQ(ground.vehicle().plans().fence.size(), items.size());
  return result;
}

/// Keeps a velocity as a ground station does: repeating it.
void fly(TestGround& ground, geo::Ned velocity_m_s, base::Duration time) {
  SetPositionTargetGlobalInt target;
  target.setpoint.ignore = 0b110111000111;
  target.setpoint.velocity_m_s = velocity_m_s;
  for (auto passed = base::Duration{}; passed < time; passed += 1s) {
    ground.send(target);
    ground.run_for(1s);
  }
}

TEST(Fence, SendsACopterHomeThatLeavesTheCircleAndItsStateStaysActive) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_RADIUS", 60}, {"FENCE_ACTION", 1}});
  ground.hover(10);
  ground.request(MessageId::fence_status, 5);
  fly(ground, {8, 0, 0}, 5s);
  EXPECT_EQ(ground.said("Circle fence breached"), 0);
  fly(ground, {8, 0, 0}, 5s);
  EXPECT_EQ(ground.said("Circle fence breached"), 1);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  EXPECT_EQ(ground.last<Heartbeat>()->system_status, MavState::active);
  EXPECT_EQ(ground.last<FenceStatus>()->breach_count, 1);
  EXPECT_EQ(ground.last<FenceStatus>()->breach_type, 3);
  EXPECT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 120s));
  ground.run_for(1s);
  EXPECT_FALSE(ground.last<FenceStatus>()->breached);
  EXPECT_EQ(ground.last<FenceStatus>()->breach_count, 1);
  EXPECT_LT(ground.from_start(), 2.0);
}

TEST(Fence, DoesWhatItsActionSays) {
  struct Case {
    float action;
    std::string_view mode;
  };
  for (auto const& [action, mode] : {Case{0, "GUIDED"}, {1, "RTL"}, {2, "LAND"}, {4, "BRAKE"}}) {
    TestGround ground("copter");
    set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_ALT_MAX", 20}, {"FENCE_ACTION", action}});
    ground.hover(10);
    ground.request(MessageId::fence_status, 5);
    fly(ground, {0, 0, -2.5}, 7s);
    EXPECT_EQ(ground.said("Max Alt fence breached"), 1) << action;
    EXPECT_EQ(ground.pilot().mode().name, mode);
    EXPECT_EQ(ground.last<FenceStatus>()->breach_type, 2) << "by height";
  }
}

TEST(Fence, HoldsTheModeUntilTheVehicleIsBackInsideIfToldSo) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_RADIUS", 40}, {"FENCE_OPTIONS", 1}});
  ground.hover(10);
  fly(ground, {8, 0, 0}, 7s);
  ASSERT_EQ(ground.pilot().mode().name, "RTL");
  EXPECT_EQ(ground.set_mode(copter_guided), MavResult::failed);
  EXPECT_EQ(ground.said("Mode change to GUIDED failed: in fence recovery"), 1);
  ASSERT_TRUE(ground.run_until([&] { return ground.pilot().fence().breached() == 0; }, 60s));
  EXPECT_EQ(ground.set_mode(copter_guided), MavResult::accepted);
}

TEST(Fence, RefusesGuidedTargetsOutside) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_RADIUS", 50}});
  ground.hover(10);
  auto const to = [&](double north_m) {
    auto const place = geo::displaced(ground.world.options().home, {north_m, 0.0, -10.0});
    return ground.command(MavCmd::do_reposition, {-1, 0, 0, NAN, static_cast<float>(place.lat_deg()),
                                                  static_cast<float>(place.lon_deg()), 10});
  };
  EXPECT_EQ(to(30), MavResult::accepted);
  EXPECT_EQ(to(80), MavResult::failed);
}

TEST(Fence, KeepsACopterInThePolygonThatWasUploaded) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 1}});
  ground.boot();
  auto const items = square(ground, MavCmd::nav_fence_polygon_vertex_inclusion, 0, 0, 50);
  ASSERT_EQ(upload_fence(ground, items), MavMissionResult::accepted);
  EXPECT_EQ(ground.vehicle().parameters().value("FENCE_TOTAL"), 4.0);
  ground.hover(10);
  fly(ground, {0, 8, 0}, 12s);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  EXPECT_EQ(ground.said("Polygon fence breached"), 1);
}

TEST(Fence, RefusesArmingInsideAnExclusionZone) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 1}});
  ground.boot();
  auto const items = std::vector{zone_item(ground, MavCmd::nav_fence_circle_exclusion, 5, 0, 30.0F)};
  ASSERT_EQ(upload_fence(ground, items), MavMissionResult::accepted);
  ground.run_for(100ms);
  ground.set_mode(copter_guided);
  EXPECT_EQ(ground.arm(), MavResult::failed);
  ground.run_for(100ms);
  EXPECT_EQ(ground.said("Arm: Vehicle breaching Polygon fence"), 1);
  EXPECT_EQ(ground.said("PreArm: Vehicle breaching Polygon fence"), 1);
  EXPECT_EQ(ground.command(MavCmd::do_fence_enable, {0}), MavResult::accepted);
  ground.run_for(100ms);
  EXPECT_EQ(ground.arm(), MavResult::accepted);
}

TEST(Fence, IsSwitchedByCommandAndReportsThatItIsOnWithItsHealth) {
  TestGround ground("copter");
  ground.boot();
  ground.request(MessageId::sys_status, 10);
  ground.run_for(500ms);
  EXPECT_NE(ground.last<SysStatus>()->sensors_present & sensor_flag::geofence, 0u) << "it could be switched on";
  EXPECT_EQ(ground.last<SysStatus>()->sensors_enabled & sensor_flag::geofence, 0u);
  EXPECT_EQ(ground.command(MavCmd::request_message, {162}), MavResult::failed);
  EXPECT_EQ(ground.command(MavCmd::do_fence_enable, {1}), MavResult::accepted);
  EXPECT_EQ(ground.command(MavCmd::request_message, {162}), MavResult::accepted);
  EXPECT_EQ(ground.last<FenceStatus>()->breach_count, 0);
  ground.run_for(500ms);
  EXPECT_NE(ground.last<SysStatus>()->sensors_enabled & sensor_flag::geofence, 0u);
  EXPECT_NE(ground.last<SysStatus>()->sensors_health & sensor_flag::geofence, 0u);
  EXPECT_EQ(ground.command(MavCmd::do_fence_enable, {7}), MavResult::failed);
}

TEST(Fence, StopsARover) {
  TestGround ground("rover");
  set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_RADIUS", 30}, {"FENCE_ACTION", 2}});
  ground.arm_in(rover_guided);
  fly(ground, {4, 0, 0}, 14s);
  EXPECT_EQ(ground.said("Circle fence breached"), 0) << "ArduRover keeps it to itself";
  EXPECT_EQ(ground.last<FenceStatus>()->breach_count, 1) << "but for this, which is sent unasked";
  EXPECT_EQ(ground.pilot().mode().name, "HOLD");
  ground.run_for(5s);
  EXPECT_LT(ground.from_start(), 45.0);
}

TEST(Fence, BringsAPlaneBack) {
  TestGround ground("plane");
  set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_TYPE", 2}, {"FENCE_RADIUS", 1000}});
  ground.arm_in(plane_take_off);
  ground.run_for(25s);
  ground.set_mode(plane_guided);
  ground.go_to(4000, 0, 60, 1s);
  ASSERT_TRUE(ground.run_until([&] { return ground.said("Circle fence breached") == 1; }, 90s));
  ground.run_for(500ms);
  EXPECT_EQ(ground.pilot().mode().name, "RTL");
  EXPECT_TRUE(ground.run_until([&] { return ground.pilot().fence().breached() == 0; }, 90s));
}

TEST(Fence, IsBreachedAnewFartherOutAndSaysWhenItIsOver) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_RADIUS", 40}, {"FENCE_ACTION", 0}});
  ground.hover(10);
  ground.request(MessageId::fence_status, 10);
  fly(ground, {8, 0, 0}, 13s);
  EXPECT_EQ(ground.said("Circle fence breached"), 3) << "at 40, 60 and 80 m";
  EXPECT_EQ(ground.last<FenceStatus>()->breach_count, 3);
  fly(ground, {-8, 0, 0}, 14s);
  EXPECT_EQ(ground.said("Fence breach cleared"), 1);
  EXPECT_FALSE(ground.last<FenceStatus>()->breached);
}

TEST(Fence, BringsACopterDownThatIsFarOutside) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 0}, {"FENCE_RADIUS", 40}, {"FENCE_ACTION", 1}});
  ground.hover(10);
  fly(ground, {10, 0, 0}, 17s);
  EXPECT_EQ(ground.command(MavCmd::do_fence_enable, {1}), MavResult::accepted);
  ground.run_for(500ms);
  EXPECT_EQ(ground.pilot().mode().name, "LAND");
  EXPECT_EQ(ground.said("Manual recovery started"), 1);
}

TEST(Fence, LeavesAVehicleAloneForTenSecondsAfterAChangeOfItsMode) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_RADIUS", 40}, {"FENCE_ACTION", 1}});
  ground.hover(10);
  fly(ground, {8, 0, 0}, 7s);
  ASSERT_EQ(ground.pilot().mode().name, "RTL");
  ASSERT_EQ(ground.set_mode(copter_guided), MavResult::accepted);
  fly(ground, {8, 0, 0}, 5s);
  EXPECT_EQ(ground.pilot().mode().name, "GUIDED") << "20 m farther out";
}

TEST(FenceMargin, IsWhereGuidedFlightStops) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_RADIUS", 60}, {"FENCE_MARGIN", 8}, {"AVOID_ENABLE", 3}});
  ground.hover(10);
  fly(ground, {6, 0, 0}, 25s);
  EXPECT_EQ(ground.pilot().mode().name, "GUIDED");
  EXPECT_NEAR(ground.from_start(), 52.0, 4.0);
}

TEST(FenceMargin, IsToldIfWanted) {
  TestGround ground("copter");
  set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_RADIUS", 60}, {"FENCE_MARGIN", 8}, {"FENCE_OPTIONS", 4}});
  ground.hover(10);
  fly(ground, {6, 0, 0}, 12s);
  EXPECT_GE(ground.said("Circle fence in "), 1);
  EXPECT_EQ(ground.said("Circle fence breached"), 1);
}

TEST(FenceMargin, IsChecked) {
  for (auto const& [margin, words] :
       {std::pair{-1.0F, "PreArm: Invalid FENCE_MARGIN value"}, {60.0F, "PreArm: FENCE_MARGIN too big"}}) {
    TestGround ground("copter");
    set(ground, {{"FENCE_ENABLE", 1}, {"FENCE_MARGIN", margin}});
    ground.boot();
    ground.run_for(1s);
    EXPECT_EQ(ground.said(words), 1);
  }
}

TEST(FenceNames, AreListed) {
  EXPECT_EQ(fence_names(FenceWatch::circle), "Circle fence");
  EXPECT_EQ(fence_names(FenceWatch::height | FenceWatch::areas), "Max Alt and Polygon fences");
  EXPECT_EQ(fence_names(15), "Max Alt, Circle, Polygon and Min Alt fences");
}

TEST(FenceAreas, IncludeEitherAllOrAny) {
  Site const site(geo::Wgs84::from_degrees(41.0, -8.0, 0.0));
  ItemMaker const make{site.anchor()};
  MissionPlan const fence{make.at(MavCmd::nav_fence_circle_inclusion, {0, 0, 0}, {50.0F}),
                          make.at(MavCmd::nav_fence_circle_inclusion, {80, 0, 0}, {50.0F})};
  Body body;
  FenceSettings settings{.enabled = true, .watched = FenceWatch::areas, .action = {Behaviour::return_home}};
  FenceWatch watch;
  FenceWatch::View const view{
      .body = body, .site = site, .home = {}, .plan = fence, .settings = settings, .position_ok = true, .now = 1s};
  EXPECT_EQ(watch.update(view).breached, FenceWatch::areas) << "in the first only";
  settings.any_inclusion = true;
  EXPECT_EQ(watch.update(view).breached, 0u);
  EXPECT_EQ(watch.breached(), 0u);
  settings.any_inclusion = false;
  body.position_m.north = 40.0;
  EXPECT_EQ(watch.update(view).breached, 0u) << "in both";
  EXPECT_EQ(watch.count(), 1);
}

TEST(FenceFloor, CountsOnceTheVehicleWasAboveIt) {
  Site const site(geo::Wgs84::from_degrees(41.0, -8.0, 0.0));
  MissionPlan const fence;
  Body body;
  FenceSettings const settings{.enabled = true, .watched = FenceWatch::floor, .lowest_m = 10.0, .action = {}};
  FenceWatch watch;
  FenceWatch::View const view{
      .body = body, .site = site, .home = {}, .plan = fence, .settings = settings, .position_ok = true, .now = 1s};
  EXPECT_EQ(watch.update(view).breached, 0u) << "on the ground";
  body.on_ground = false;
  body.position_m.down = -5.0;
  EXPECT_EQ(watch.update(view).breached, 0u) << "on its way up";
  body.position_m.down = -12.0;
  EXPECT_EQ(watch.update(view).breached, 0u);
  body.position_m.down = -9.0;
  EXPECT_EQ(watch.update(view).breached, FenceWatch::floor);
}

}  // namespace
}  // namespace lapwing::sim
