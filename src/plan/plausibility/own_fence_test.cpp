#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "plan/plausibility/judge.hpp"

// The fence that the vehicle keeps to by itself: what leaves it is refused, with the limit's own name.
namespace lapwing::plan::plausibility {
namespace {

using geo::Wgs84;
using mavlink::MavCmd;
using mavlink::MissionItem;
using vehicle::Autopilot;
using vehicle::Family;

constexpr Wgs84 field = Wgs84::from_degrees(41.1780, -8.5980, 90.0);

Wgs84 at(double north_m, double east_m = 0.0) {
  return geo::displaced(field, {.north = north_m, .east = east_m});
}
MissionItem item(MavCmd command, Wgs84 place, double up_m) {
  MissionItem made;
  made.command = command;
  made.frame = mavlink::MavFrame::global_relative_alt;
  made.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = up_m};
  return made;
}
MissionItem go(Wgs84 place, double up_m = 30.0) {
  return item(MavCmd::nav_waypoint, place, up_m);
}
MissionItem switching(float param) {
  MissionItem made;
  made.command = MavCmd::do_fence_enable;
  made.params[0] = param;
  return made;
}
Mission flight(std::vector<MissionItem> on_the_way) {
  on_the_way.insert(on_the_way.begin(), item(MavCmd::nav_takeoff, field, 30.0));
  on_the_way.push_back(item(MavCmd::nav_land, field, 0.0));
  return {.name = "M", .home = field, .items = std::move(on_the_way)};
}
GeoZone circle(Wgs84 center, double radius_m, Zone::Kind kind = Zone::Kind::inclusion) {
  return {.kind = kind, .area = GeoCircle{center, radius_m}};
}
GeoZone square(double half_m) {
  GeoRing const ring{at(half_m, half_m), at(half_m, -half_m), at(-half_m, -half_m), at(-half_m, half_m)};
  return {.area = std::vector{GeoPolygon{{ring}}}};
}

Situation standing_with(VehicleFence fence, Family family = Family::copter,
                        Autopilot autopilot = Autopilot::ardupilot) {
  return {.vehicle = "copter 1",
          .family = family,
          .autopilot = autopilot,
          .position = field,
          .home = field,
          .on_ground = true,
          .own_fence = std::move(fence)};
}
Situation flying_at(Wgs84 place, VehicleFence fence) {
  auto now = standing_with(std::move(fence));
  now.position = Wgs84{place.lat_rad, place.lon_rad, 120.0};
  now.on_ground = false;
  return now;
}
VehicleFence const three_hundred{.radius_m = 300.0, .margin_m = 2.0};
VehicleFence const with_heights{.highest_m = 50.0, .lowest_m = 10.0, .margin_m = 2.0};

std::string text(Findings const& findings) {
  std::string all;
  for (auto const& finding : findings)
    all += (finding.severity == Severity::refuse ? "refuse: " : "warn: ") + to_text(finding) + "\n";
  return all;
}

TEST(OwnFence, RefusesWhatIsBeyondTheCircleRoundHome) {
  auto const found = judge(flight({go(at(420)), go(at(350)), go(at(100))}), standing_with(three_hundred), {});
  EXPECT_EQ(text(found),
            "refuse: item 2 (and 1 more) is 120 m outside copter 1's own fence: 300 m round home (FENCE_RADIUS); it "
            "would break off there: bring it inside, or set FENCE_RADIUS on the vehicle [outside_fence]\n");
}

TEST(OwnFence, SaysWhatIsNearerToItThanItsMargin) {
  auto const found = judge(flight({go(at(299))}), standing_with(three_hundred), {});
  EXPECT_EQ(text(found),
            "warn: item 2 is only 1.0 m inside copter 1's own fence: 300 m round home (FENCE_RADIUS); it keeps 2.0 m "
            "of margin [outside_fence]\n");
  EXPECT_EQ(text(judge(flight({go(at(290))}), standing_with(three_hundred), {})), "");
}

TEST(OwnFence, IsRoundTheHomeThatTheMissionSets) {
  auto mission = flight({go(at(350))});
  mission.home = at(80);
  EXPECT_EQ(text(judge(mission, standing_with(three_hundred), {})), "");
}

TEST(OwnFence, RefusesHeightsBeyondIt) {
  EXPECT_NE(text(judge(flight({go(at(100), 70)}), standing_with(with_heights), {}))
                .find("refuse: item 2 is 20.0 m above copter 1's own fence: 50 m above home (FENCE_ALT_MAX)"),
            std::string::npos);
  EXPECT_NE(text(judge(flight({go(at(100), 5)}), standing_with(with_heights), {}))
                .find("refuse: item 2 is 5.0 m below copter 1's own fence: 10 m above home (FENCE_ALT_MIN)"),
            std::string::npos);
  EXPECT_EQ(text(judge(flight({go(at(100), 40)}), standing_with(with_heights), {})), "")
      << "the way up and down is below its floor";
}

TEST(OwnFence, HasNoHeightsForRovers) {
  auto const mission = Mission{.name = "M", .home = field, .items = {go(at(100), 0.0)}};
  EXPECT_EQ(text(judge(mission, standing_with(with_heights, Family::rover), {})), "");
}

TEST(OwnFence, IsNamedAsPx4Has) {
  auto fence = with_heights;
  fence.radius_m = 300.0;
  auto const found = text(judge(flight({go(at(400), 70)}), standing_with(fence, Family::copter, Autopilot::px4), {}));
  EXPECT_NE(found.find("(GF_MAX_HOR_DIST)"), std::string::npos) << found;
  EXPECT_NE(found.find("(GF_MAX_VER_DIST)"), std::string::npos) << found;
}

TEST(OwnFence, RefusesTheWayThroughWhatItShutsOut) {
  VehicleFence const tower{.areas = {.zones = {circle(at(100), 20.0, Zone::Kind::exclusion)}}};
  auto const found = text(judge(flight({go(at(200))}), standing_with(tower), {}));
  EXPECT_NE(found.find("refuse: item 2 or the way there is 20.0 m inside what copter 1's own fence shuts out: stored "
                       "area 1; it would break off there: bring it inside, or upload another fence"),
            std::string::npos)
      << found;
  EXPECT_EQ(text(judge(flight({go(at(0, 100))}), standing_with(tower), {})), "");
}

TEST(OwnFence, StaysInEveryInclusionUnlessOneWillDo) {
  VehicleFence fence{.areas = {.zones = {square(200.0), circle(at(300), 200.0)}}};
  auto const mission = flight({go(at(150)), go(at(250))});
  EXPECT_NE(text(judge(mission, standing_with(fence), {})).find("stored area 1"), std::string::npos);
  fence.one_inclusion_will_do = true;
  EXPECT_EQ(text(judge(mission, standing_with(fence), {})), "");
}

TEST(OwnFence, OfAnotherPlaceIsToldFromAPlanThatLeavesIt) {
  auto const lisbon = Wgs84::from_degrees(38.7223, -9.1393);
  VehicleFence const elsewhere{.areas = {.zones = {circle(lisbon, 500.0)}}};
  auto const found = text(judge(flight({go(at(100))}), standing_with(elsewhere), {}));
  EXPECT_NE(found.find("copter 1 stands 276 km outside its own fence: stored area 1"), std::string::npos) << found;
  EXPECT_NE(found.find("the fence of another place?"), std::string::npos) << found;
  VehicleFence const overseas{.areas = {.zones = {circle(Wgs84::from_degrees(41.0, 8.6), 500.0)}}};
  EXPECT_NE(text(judge(flight({go(at(100))}), standing_with(overseas), {})).find("outside_fence"), std::string::npos);
}

TEST(OwnFence, IsNotLookedAtWhereTheMissionSwitchesItOff) {
  auto const off = flight({go(at(100)), switching(0.0F), go(at(500)), go(at(100)), switching(1.0F), go(at(50))});
  EXPECT_EQ(text(judge(off, standing_with(three_hundred), {})), "");
  EXPECT_EQ(text(judge(off, standing_with({.areas = {.zones = {square(200.0)}}}), {})), "");
  auto const on_again = flight({switching(0.0F), go(at(100)), switching(1.0F), go(at(500))});
  EXPECT_NE(text(judge(on_again, standing_with(three_hundred), {})), "");
  auto const floorless = flight({switching(2.0F), go(at(100), 5)});
  EXPECT_EQ(text(judge(floorless, standing_with(with_heights), {})), "");
}

TEST(OwnFence, IsOnlySaidWhereTheVehicleWouldOnlyReportABreach) {
  auto fence = three_hundred;
  fence.only_tells = true;
  auto const found = text(judge(flight({go(at(420))}), standing_with(fence), {}));
  EXPECT_NE(found.find("warn: item 2 is 120 m outside"), std::string::npos) << found;
  EXPECT_NE(found.find("it would report a breach"), std::string::npos) << found;
}

TEST(OwnFence, IsAllowedByName) {
  Settings settings;
  ASSERT_TRUE(add_allowance(settings, "outside_fence=the club's leave"));
  EXPECT_EQ(refusal(judge(flight({go(at(420))}), standing_with(three_hundred), settings)), nullptr);
}

TEST(OwnFence, SaysThatNobodyKnowsWhereTheVehicleHasNotToldItsHome) {
  auto homeless = standing_with(three_hundred);
  homeless.home.reset();
  auto mission = flight({go(at(420))});
  mission.home.reset();
  EXPECT_EQ(text(judge(mission, homeless, {})),
            "warn: copter 1 has not told its home; nobody knows whether this leaves its own fence, which is measured "
            "from there [outside_fence]\n");
  EXPECT_NE(text(judge(flight({go(at(420))}), homeless, {})).find("refuse: item 2 is 120 m outside"), std::string::npos)
      << "the mission's own home is known";
}

// ---- by hand

TEST(OwnFence, KeepsAnOperatorIn) {
  auto const found = text(judge(GoTo{at(420), std::nullopt}, flying_at(at(100), three_hundred), {}));
  EXPECT_EQ(found,
            "refuse: the place is 120 m outside copter 1's own fence: 300 m round home (FENCE_RADIUS); it would break "
            "off there: bring it inside, or set FENCE_RADIUS on the vehicle [outside_fence]\n");
  EXPECT_NE(text(judge(GoTo{at(100), 60.0}, flying_at(at(0), with_heights), {})).find("10.0 m above"),
            std::string::npos);
  EXPECT_NE(text(judge(GoTo{at(100), 4.0}, flying_at(at(0), with_heights), {})).find("6.0 m below"), std::string::npos);
  EXPECT_EQ(text(judge(GoTo{at(100), std::nullopt}, flying_at(at(0), with_heights), {})), "");
}

TEST(OwnFence, LetsAnOperatorBringTheVehicleBackIn) {
  VehicleFence const fence{.radius_m = 300.0, .areas = {.zones = {square(200.0)}}};
  EXPECT_EQ(text(judge(GoTo{at(100), std::nullopt}, flying_at(at(400), fence), {})), "");
}

TEST(OwnFence, KeepsATakeOffIn) {
  EXPECT_NE(text(judge_take_off(60.0, standing_with(with_heights), {}))
                .find("refuse: the take-off is 10.0 m above copter 1's own fence: 50 m above home (FENCE_ALT_MAX)"),
            std::string::npos);
  EXPECT_EQ(text(judge_take_off(30.0, standing_with(with_heights), {})), "");
  auto outside = standing_with({.areas = {.zones = {square(200.0)}}});
  outside.position = at(350);
  EXPECT_NE(text(judge_take_off(30.0, outside, {})).find("copter 1 stands 150 m outside its own fence"),
            std::string::npos);
}

}  // namespace
}  // namespace lapwing::plan::plausibility
