#include "plan/files/plan_file.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "plan/estimate.hpp"

namespace lapwing::plan {
namespace {

using enum mavlink::MavCmd;
using mavlink::MavFrame;

Plan read(std::string_view file, std::string_view text) {
  auto const read = read_plan(file, text);
  EXPECT_TRUE(read) << (read ? "" : read.error().message);
  return read ? read->plan : Plan{};
}
/// Why it is not flown.
std::string message_of(std::string_view file, std::string_view text) {
  auto const read = read_plan(file, text);
  if (!read) return read.error().message;
  auto const mission = mission_to_fly(file, read->plan);
  return mission ? "it is read" : mission.error().message;
}

// ---- way points

constexpr auto way_points =
    "QGC WPL 110\r\n"
    "0\t1\t0\t16\t0\t0\t0\t0\t41.0\t-8.5\t90.0\t1\r\n"
    "1\t0\t3\t22\t15\t0\t0\t0\t0\t0\t30\t1\r\n"
    "2 0 3 16 0 0 0 0 41.001 -8.5 40 1\r\n"
    "3\t0\t0\t16\t0\t0\t0\t0\t41.002\t-8.5\t150\t0\r\n"
    "\r\n"
    "4\t0\t3\t177\t2\t-1\t0\t0\t0\t0\t0\t1\r\n";

TEST(WayPoints, AreReadWithTheirFrames) {
  auto const mission = read("plans/north.waypoints", way_points).mission;
  EXPECT_EQ(mission.name, "north");
  EXPECT_FALSE(mission.home);
  EXPECT_EQ(mission.planned_home, geo::Wgs84::from_degrees(41.0, -8.5, 90.0));
  ASSERT_EQ(mission.items.size(), 4u);
  EXPECT_EQ(mission.items[0].command, nav_takeoff);
  EXPECT_EQ(mission.items[0].frame, MavFrame::global_relative_alt);
  EXPECT_EQ(mission.items[1].params[3], 0.0F);
  EXPECT_NEAR(position_of(mission.items[1]).lat_deg(), 41.001, 1e-9);
  EXPECT_EQ(mission.items[2].frame, MavFrame::global);
  EXPECT_FALSE(mission.items[2].autocontinue);
  EXPECT_EQ(mission.items[3].params[0], 2.0F);
}

TEST(WayPoints, AreFlownWithHomeInFrontOnArduPilot) {
  auto const mission = read("a.waypoints", way_points).mission;
  auto const home = geo::Wgs84::from_degrees(42.0, -8.5, 10.0);
  auto const items = for_autopilot(mission, vehicle::Autopilot::ardupilot, home, vehicle::Family::copter);
  ASSERT_EQ(items.size(), 5u);
  EXPECT_EQ(position_of(items[0]), home);
  EXPECT_EQ(items[4].params[0], 2.0F);
  EXPECT_EQ(for_autopilot(mission, vehicle::Autopilot::px4, home)[3].params[0], 1.0F);
}

TEST(WayPoints, OfVersion120HaveNoHomeLine) {
  auto const mission =
      read("a.waypoints", "QGC WPL 120\n0 1 3 22 0 0 0 0 41 -8 30 1\n1 0 2 177 0 2 0 0 0 0 0 1").mission;
  ASSERT_EQ(mission.items.size(), 2u);
  EXPECT_FALSE(mission.planned_home);
  EXPECT_EQ(mission.items[1].params[0], 1.0F);
}

TEST(WayPoints, AreEstimatedAboveThePlannedHome) {
  auto const mission =
      read("a.waypoints", "QGC WPL 110\n0 1 0 16 0 0 0 0 41 -8 90 1\n1 0 3 22 0 0 0 0 0 0 30 1").mission;
  EXPECT_NEAR(estimate(mission).path_m, 30.0, 1e-6);
}

TEST(WayPoints, ThatAreWrongNameTheLine) {
  auto const in_line_2 = [](std::string_view line) {
    return message_of("a.waypoints", fmt::format("QGC WPL 110\n{}\n", line));
  };
  EXPECT_EQ(in_line_2("0 1 0 16 0 0 0 0 41 -8 90"), "a.waypoints:2: an item has 12 columns, not 11");
  EXPECT_EQ(in_line_2("0 1 0 16 0 0 0 0 41 -8 90 1 1 1"), "a.waypoints:2: an item has 12 columns, not more");
  EXPECT_EQ(in_line_2("0 1 0 16 0 x 0 0 41 -8 90 1"), "a.waypoints:2: column 6: 'x' is no number");
  EXPECT_EQ(in_line_2("1 1 0 16 0 0 0 0 41 -8 90 1"), "a.waypoints:2: item 1 comes where item 0 should");
  EXPECT_EQ(in_line_2("0 1 0 16 0 0 0 0 95 -8 90 1"), "a.waypoints:2: latitude 95 is beyond 90 degrees");
  EXPECT_EQ(in_line_2("0 1 1 16 0 0 0 0 41 -8 90 1"), "a.waypoints:2: frame 1 is not supported");
  EXPECT_EQ(in_line_2("0 1 0 65000 0 0 0 0 41 -8 90 1"), "a.waypoints:2: command 65000 is not known here");
  EXPECT_EQ(in_line_2("0 1 0 1.5 0 0 0 0 41 -8 90 1"), "a.waypoints:2: 1.5 is no command");
  EXPECT_EQ(in_line_2("0 1 0 16 1e300 0 0 0 41 -8 90 1"), "a.waypoints:2: parameter 1 is too large: 1e+300");
  EXPECT_EQ(in_line_2("0 1 0 16 0 0 0 0 41 -8 inf 1"), "a.waypoints:2: height inf m is no height to fly at");
  EXPECT_EQ(in_line_2("0 1 0 16 0 0 0 0 41 -8 nan 1"), "a.waypoints:2: height nan m is no height to fly at");
  EXPECT_EQ(in_line_2("0 1 0 177 1 nan 0 0 0 0 0 1"),
            "a.waypoints:2: a jump needs the number of an item, and how many times (-1 for ever)");
  EXPECT_EQ(in_line_2(""), "a.waypoints: the plan has no items");
  EXPECT_EQ(message_of("a.waypoints", "QGC WPL 99\n"), "a.waypoints:1: this version of way point files is not known");
  EXPECT_EQ(message_of("a.waypoints", "QGC WPL 110\n0 1 0 16 0 0 0 0 41 -8 90 1\n1 0 0 177 7 1 0 0 0 0 0 1\n"),
            "a.waypoints: a jump leads to item 7, which is not there");
}

// ---- plans

std::string plan_of(std::string_view items, std::string_view more = "") {
  return fmt::format(R"({{"fileType": "Plan", "version": 1, "groundStation": "QGroundControl",
  "mission": {{"version": 2, "firmwareType": 3, "vehicleType": 2, "cruiseSpeed": 15, "hoverSpeed": 5,
    "plannedHomePosition": [41.0, -8.5, 90], "items": [{}]}}{}}})",
                     items, more);
}
std::string simple(int command, std::string_view params, int id, int frame = 3) {
  return fmt::format(
      R"({{"type": "SimpleItem", "autoContinue": true, "command": {}, "doJumpId": {}, "frame": {}, "params": [{}]}})",
      command, id, frame, params);
}

TEST(QgcPlan, OfSimpleItemsIsRead) {
  auto const items = simple(22, "15, 0, 0, null, 41.0, -8.5, 30", 1) + "," + simple(178, "1, 5, -1, 0, 0, 0, 0", 2, 2) +
                     "," + simple(16, "0,0,0,null,41.1,-8.5,40", 3);
  auto const plan = read("area.plan", plan_of(items));
  EXPECT_EQ(plan.mission.name, "area");
  EXPECT_EQ(plan.mission.planned_home, geo::Wgs84::from_degrees(41.0, -8.5, 90.0));
  ASSERT_EQ(plan.mission.items.size(), 3u);
  EXPECT_TRUE(std::isnan(plan.mission.items[0].params[3]));
  EXPECT_EQ(plan.mission.items[1].frame, MavFrame::mission);
  EXPECT_EQ(plan.mission.items[2].place.z_m, 40.0);
}

TEST(QgcPlan, TranslatesTheNumbersOfJumps) {
  auto const items = simple(22, "0,0,0,0,41,-8,30", 1) + "," + simple(16, "0,0,0,0,41,-8,30", 7) + "," +
                     simple(177, "7,3,0,0,0,0,0", 9, 2);
  EXPECT_EQ(read("a.plan", plan_of(items)).mission.items[2].params[0], 2.0F);
  EXPECT_EQ(message_of("a.plan", plan_of(simple(177, "7,3,0,0,0,0,0", 1, 2))),
            "a.plan: mission.items[0]: the jump leads to item 7, which is not there");
  EXPECT_EQ(message_of("a.plan", plan_of(R"({"type": "SimpleItem", "command": 16, "doJumpId": "7", "frame": 3,
                                            "params": [0, 0, 0, 0, 41, -8, 30]})")),
            "a.plan: mission.items[0].doJumpId: a number was expected");
}

TEST(QgcPlan, FliesTheItemsThatAreStoredWithASurvey) {
  auto const stored = simple(16, "0,0,0,null,41,-8,30", 2) + "," + simple(206, "25,0,1,0,0,0,0", 3, 2) + "," +
                      simple(16, "0,0,0,null,41.1,-8,30", 4);
  auto const survey = fmt::format(R"({{"type": "ComplexItem", "complexItemType": "survey", "version": 5, "angle": 0,
    "TransectStyleComplexItem": {{"version": 2, "Items": [{}]}}}})",
                                  stored);
  auto const mission = read("a.plan", plan_of(simple(22, "0,0,0,0,41,-8,30", 1) + "," + survey)).mission;
  ASSERT_EQ(mission.items.size(), 4u);
  EXPECT_EQ(mission.items[2].command, do_set_cam_trigg_dist);
}

TEST(QgcPlan, FliesALandingPattern) {
  auto const pattern = [](std::string_view kind) {
    return fmt::format(R"({{"type": "ComplexItem", "complexItemType": "{}", "altitudesAreRelative": true,
      "landCoordinate": [41.0, -8.5, 0], "landingApproachCoordinate": [41.01, -8.5, 40], "loiterClockwise": false,
      "loiterRadius": 75, "stopTakingPhotos": true, "useLoiterToAlt": true, "version": 2}})",
                       kind);
  };
  auto const mission = read("a.plan", plan_of(pattern("fwLandingPattern"))).mission;
  ASSERT_EQ(mission.items.size(), 4u);
  EXPECT_EQ(mission.items[0].command, do_land_start);
  EXPECT_EQ(mission.items[1].command, image_stop_capture);
  EXPECT_EQ(mission.items[2].command, nav_loiter_to_alt);
  EXPECT_EQ(mission.items[2].params[1], -75.0F);
  EXPECT_EQ(mission.items[2].frame, MavFrame::global_relative_alt);
  EXPECT_EQ(mission.items[3].command, nav_land);
  EXPECT_EQ(read("a.plan", plan_of(pattern("vtolLandingPattern"))).mission.items[3].command, nav_vtol_land);
}

TEST(QgcPlan, HoldsAFenceAndRallyPoints) {
  auto const more = R"(, "geoFence": {"version": 2, "breachReturn": [41.2, -8.5, 40],
      "circles": [{"circle": {"center": [41.1, -8.4], "radius": 30.5}, "inclusion": false, "version": 1}],
      "polygons": [{"inclusion": true, "polygon": [[41, -8], [41, -7], [42, -7]], "version": 1}]},
    "rallyPoints": {"points": [[41, -8.6, 25]], "version": 2})";
  auto const plan = read("a.plan", plan_of(simple(16, "0,0,0,0,41,-8,30", 1), more));
  ASSERT_EQ(plan.fence.zones.size(), 2u);
  EXPECT_EQ(plan.fence.zones[0].kind, Zone::Kind::inclusion);
  EXPECT_EQ(std::get<std::vector<GeoPolygon>>(plan.fence.zones[0].area)[0].rings[0].size(), 3u);
  auto const& circle = std::get<GeoCircle>(plan.fence.zones[1].area);
  EXPECT_EQ(plan.fence.zones[1].kind, Zone::Kind::exclusion);
  EXPECT_EQ(circle.radius_m, 30.5);
  EXPECT_NEAR(circle.center.lat_deg(), 41.1, 1e-12);
  EXPECT_EQ(plan.fence.breach_return->alt_m, 40.0);
  ASSERT_EQ(plan.rally.size(), 1u);
  EXPECT_EQ(plan.rally[0].place.alt_m, 25.0);
  EXPECT_EQ(plan.cruise_speed_m_s, 15.0);
  EXPECT_EQ(plan.firmware_type, 3);
}

TEST(QgcPlan, RefusesAFenceThatIsNone) {
  auto const with_fence = [](std::string_view fence) {
    return message_of("a.plan", plan_of(simple(16, "0,0,0,0,41,-8,30", 1), fmt::format(", \"geoFence\": {}", fence)));
  };
  EXPECT_EQ(with_fence(R"({"polygons": [{"polygon": [[1, 2], [3, 4]]}]})"),
            "a.plan: geoFence.polygons[0].polygon: a polygon needs at least three corners");
  EXPECT_EQ(with_fence(R"({"polygons": [{"polygon": [[1, 2], [95, 4], [5, 6]]}]})"),
            "a.plan: geoFence.polygons[0].polygon[1]: latitude 95 is beyond 90 degrees");
  EXPECT_EQ(with_fence(R"({"circles": [{"circle": {"center": [1, 2], "radius": -1}}]})"),
            "a.plan: geoFence.circles[0].circle: -1 m is no radius");
  EXPECT_EQ(with_fence(R"({"circles": {}})"), "a.plan: geoFence.circles: a list [ ... ] was expected");
}

TEST(QgcPlan, KeepsWhatAPatternWasDrawnFrom) {
  auto const plan =
      read("a.plan", plan_of(simple(22, "0,0,0,0,41,-8,30", 1) +
                             R"(, {"type": "ComplexItem", "complexItemType": "StructureScan", "Layers": 3})"));
  ASSERT_EQ(plan.patterns.size(), 1u);
  EXPECT_EQ(plan.patterns[0].first, 1u);
  EXPECT_EQ(plan.patterns[0].count, 0u);
  EXPECT_NE(plan.patterns[0].json.find("\"Layers\":3"), std::string::npos);
}

TEST(QgcPlan, OfTheFirstVersionHoldsPlacesApart) {
  auto const item = R"({"type": "SimpleItem", "command": 16, "frame": 3, "params": [0, 0, 0, 0],
                        "coordinate": [41.0, -8.0, 25]})";
  EXPECT_EQ(read("a.plan", plan_of(item)).mission.items[0].place.z_m, 25.0);
}

TEST(QgcPlan, ThatIsWrongNamesThePath) {
  auto const with_item = [](std::string_view item) { return message_of("a.plan", plan_of(item)); };
  EXPECT_EQ(with_item(simple(16, "0,0,0,0,true,-8,30", 1)),
            "a.plan: mission.items[0].params[4]: a number was expected");
  EXPECT_EQ(with_item(simple(16, "0,0,0,0,95,-8,30", 1)), "a.plan: mission.items[0]: latitude 95 is beyond 90 degrees");
  EXPECT_EQ(with_item(simple(16, "0,0,0,0,1,2,3,4,5", 1)),
            "a.plan: mission.items[0].params: at most 7 numbers were expected");
  EXPECT_EQ(with_item(R"({"type": "SimpleItem", "frame": 3, "params": []})"),
            "a.plan: mission.items[0]: \"command\" is missing");
  EXPECT_EQ(with_item(R"({"type": "SimpleItem", "command": "16", "frame": 3, "params": []})"),
            "a.plan: mission.items[0].command: a number was expected");
  EXPECT_EQ(with_item(R"({"type": "Item"})"),
            "a.plan: mission.items[0]: an item's type is SimpleItem or ComplexItem, not 'Item'");
  EXPECT_EQ(with_item(R"({"type": "ComplexItem", "complexItemType": "StructureScan"})"),
            "a.plan: a complex item of the plan (a structure scan?) holds no items to fly");
  EXPECT_EQ(with_item("7"), "a.plan: mission.items[0]: an item's type is SimpleItem or ComplexItem, not ''");
  EXPECT_EQ(with_item(""), "a.plan: the plan has no items");
}

TEST(QgcPlan, ThatIsNoPlanSaysSo) {
  EXPECT_EQ(message_of("a.plan", ""), "a.plan: the file is empty");
  EXPECT_EQ(message_of("a.plan", "{\n \"a\": ]"), "a.plan:2:7: this is no JSON");
  EXPECT_EQ(message_of("a.plan", "[]"),
            "a.plan: this is no plan: neither \"fileType\" is \"Plan\" nor is there a GeoJSON \"type\"");
  EXPECT_EQ(message_of("a.plan", R"({"fileType": "Plan"})"), "a.plan: \"mission\" is missing");
  EXPECT_EQ(message_of("a.plan", R"({"fileType": "Plan", "mission": 7})"),
            "a.plan: mission: an object { ... } was expected");
  EXPECT_EQ(message_of("a.plan", R"({"fileType": "Plan", "mission": {"items": {}}})"),
            "a.plan: mission.items: a list [ ... ] was expected");
  EXPECT_EQ(message_of("a.plan", std::string(max_plan_bytes + 1, ' ')),
            "a.plan: 16 MB is too large for a plan (limit 16 MB)");
  EXPECT_NE(message_of("a.plan", std::string(1'000'000, '[')), "it is read");
  auto const deep = std::string(200'000, '[') + std::string(200'000, ']');
  EXPECT_EQ(message_of("a.plan", plan_of(R"({"type": "ComplexItem", "complexItemType": "x", "more": )" + deep + "}")),
            "a.plan: values are nested deeper than 64");
}

TEST(WayPoints, AreNoMoreThanCanBeCountedWithHome) {
  auto const file = [](std::size_t items) {
    std::string text = "QGC WPL 110\n0 1 0 16 0 0 0 0 41 -8 0 1\n";
    for (std::size_t i = 1; i <= items; ++i) text += fmt::format("{} 0 3 16 0 0 0 0 41 -8 30 1\n", i);
    return message_of("a.waypoints", text);
  };
  EXPECT_EQ(file(max_mission_items - 1), "it is read");
  EXPECT_EQ(file(max_mission_items), "a.waypoints: more items than a mission can hold");
}

TEST(WayPoints, CanBeAFenceOrRallyPoints) {
  auto const fence = read("f.waypoints",
                          "QGC WPL 110\n0 0 0 5001 3 0 0 0 41 -8 0 1\n1 0 0 5001 3 0 0 0 41 -7 0 1\n"
                          "2 0 0 5001 3 0 0 0 42 -7 0 1\n3 0 0 5004 50 0 0 0 41.5 -7.5 0 1\n");
  EXPECT_TRUE(fence.mission.items.empty());
  ASSERT_EQ(fence.fence.zones.size(), 2u);
  EXPECT_EQ(std::get<GeoCircle>(fence.fence.zones[1].area).radius_m, 50.0);
  auto const rally = read("r.waypoints", "QGC WPL 110\n0 1 0 16 0 0 0 0 41 -8 9 1\n1 0 3 5100 0 0 0 0 41 -8 25 1\n");
  ASSERT_EQ(rally.rally.size(), 1u);
  EXPECT_EQ(rally.mission.planned_home->alt_m, 9.0);
  EXPECT_EQ(message_of("m.waypoints", "QGC WPL 120\n0 0 3 16 0 0 0 0 41 -8 25 1\n1 0 3 5100 0 0 0 0 41 -8 25 1\n"),
            "m.waypoints: item 0 (NAV_WAYPOINT): this is no rally point");
}

TEST(PlanFormat, IsToldByTheEnding) {
  EXPECT_EQ(format_of("a/b.plan"), PlanFormat::qgc_plan);
  EXPECT_EQ(format_of("b.kmz"), PlanFormat::kmz);
  EXPECT_EQ(format_of("b.doc").error().message, "b.doc: the ending is that of no plan file");
}

TEST(PlanName, IsTheFilesWithoutFolderAndEnding) {
  EXPECT_EQ(plan_name("plans/survey 1.plan"), "survey 1");
  EXPECT_EQ(plan_name("a.b.waypoints"), "a.b");
  EXPECT_EQ(plan_name(".plan"), ".plan");
}

}  // namespace
}  // namespace lapwing::plan
