#include "plan/files/vehicle_plan.hpp"

#include <gtest/gtest.h>

namespace lapwing::plan {
namespace {

using mavlink::MavCmd;
using mavlink::MissionType;
using Polygons = std::vector<GeoPolygon>;

GeoRing ring(double at_deg, int corners = 4) {
  GeoRing ring;
  for (int i = 0; i < corners; ++i)
    ring.push_back(geo::Wgs84::from_degrees(41.0 + at_deg + 0.01 * i, -8.0 + 0.01 * (i % 2)));
  return ring;
}

TEST(FenceItems, SayThePolygonInEveryCorner) {
  GeoFence const fence{
      .zones = {{.area = Polygons{{{ring(0)}}}}, {.kind = Zone::Kind::exclusion, .area = GeoCircle{ring(1)[0], 30.0}}},
      .breach_return = geo::Wgs84::from_degrees(41, -8, 20)};
  auto const items = fence_items(fence);
  ASSERT_EQ(items.size(), 6u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(items[i].command, MavCmd::nav_fence_polygon_vertex_inclusion);
    EXPECT_EQ(items[i].params[0], 4.0F);
    EXPECT_EQ(items[i].type, MissionType::fence);
  }
  EXPECT_EQ(items[4].command, MavCmd::nav_fence_circle_exclusion);
  EXPECT_EQ(items[4].params[0], 30.0F);
  EXPECT_EQ(items[5].command, MavCmd::nav_fence_return_point);
  EXPECT_EQ(items[5].seq, 5);

  auto const back = fence_from(items);
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->zones.size(), 2u);
  EXPECT_EQ(std::get<Polygons>(back->zones[0].area)[0].rings[0], ring(0));
  EXPECT_EQ(back->zones[1].kind, Zone::Kind::exclusion);
  EXPECT_EQ(back->breach_return->alt_m, 20.0);
}

TEST(FenceFromItems, SaysWhichItemIsWrong) {
  auto const message_of = [](std::vector<mavlink::MissionItem> const& items) {
    auto const fence = fence_from(items);
    return fence ? "none" : fence.error().message;
  };
  auto items = fence_items({.zones = {{.area = Polygons{{{ring(0)}}}}}});
  auto cut = items;
  cut.pop_back();
  EXPECT_EQ(message_of(cut), "item 0 (NAV_FENCE_POLYGON_VERTEX_INCLUSION): a polygon of 4 corners is not there");
  items[2].command = MavCmd::nav_fence_polygon_vertex_exclusion;
  EXPECT_EQ(message_of(items), "item 2 (NAV_FENCE_POLYGON_VERTEX_EXCLUSION): it interrupts a polygon");
  EXPECT_EQ(message_of({{.frame = mavlink::MavFrame::global, .command = MavCmd::nav_waypoint}}),
            "item 0 (NAV_WAYPOINT): this belongs to no fence");
  EXPECT_EQ(message_of(fence_items({.zones = {{.area = GeoCircle{ring(0)[0], 5e23}}}})),
            "item 0 (NAV_FENCE_CIRCLE_INCLUSION): 5e+23 m is no radius");
}

TEST(SimpleFence, TurnsHolesAndSeveralPolygonsIntoZones) {
  std::vector<std::string> lost;
  GeoFence const fence{
      .zones = {
          {.name = "field", .area = Polygons{{{ring(0), ring(0.001, 3)}}}},
          {.kind = Zone::Kind::exclusion, .area = Polygons{{{ring(1)}}, {{ring(2)}}}},
          {.area = Polygons{{{ring(3)}}, {{ring(4)}}}},
          {.kind = Zone::Kind::exclusion, .area = GeoCircle{ring(5)[0], 9.0}, .highest = HeightLimit{50.0, false}}}};
  auto const simple = simple_fence(fence, lost);
  ASSERT_EQ(simple.zones.size(), 5u);
  EXPECT_EQ(simple.zones[0].kind, Zone::Kind::inclusion);
  EXPECT_EQ(simple.zones[1].kind, Zone::Kind::exclusion);  // the hole
  EXPECT_EQ(lost, (std::vector<std::string>{"fence zone 'field': its name",
                                            "fence zone 'field': its holes become zones to stay out of",
                                            "fence zone 2: its 2 polygons are one zone; they become several",
                                            "fence zone 3: its 2 polygons are one zone, which cannot be said",
                                            "fence zone 4: its limits of height"}));
}

TEST(RallyItems, ComeBackAsTheyWere) {
  std::vector<RallyPoint> const rally{{geo::Wgs84::from_degrees(41, -8, 20)},
                                      {geo::Wgs84::from_degrees(41, -7, 120), mavlink::MavFrame::global}};
  auto const items = rally_items(rally);
  EXPECT_EQ(items[1].type, MissionType::rally);
  auto const back = rally_from(items);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), 2u);
  EXPECT_EQ((*back)[0].place, rally[0].place);
  EXPECT_EQ((*back)[1].frame, mavlink::MavFrame::global);
  EXPECT_FALSE(rally_from(std::vector{mavlink::MissionItem{.command = MavCmd::nav_land}}));
}

TEST(MissionFromItems, UndoesWhatAnAutopilotWants) {
  Mission mission;
  mission.items.resize(2);
  mission.items[0].command = MavCmd::nav_takeoff;
  mission.items[1] = {.command = MavCmd::do_jump, .params = {1.0F, 3.0F}};
  auto const home = geo::Wgs84::from_degrees(41, -8, 90);
  using enum vehicle::Autopilot;
  for (auto const autopilot : {ardupilot, px4}) {
    auto const back = mission_from(for_autopilot(mission, autopilot, home), autopilot);
    ASSERT_EQ(back.items.size(), 2u);
    EXPECT_EQ(back.items[0].command, MavCmd::nav_takeoff);
    EXPECT_EQ(back.items[1].params[0], 1.0F);
    EXPECT_EQ(back.planned_home.has_value(), autopilot == ardupilot);
  }
  EXPECT_TRUE(mission_from({}, ardupilot).items.empty());
}

}  // namespace
}  // namespace lapwing::plan
