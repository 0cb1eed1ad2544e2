#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "plan/files/plan_file.hpp"

namespace lapwing::plan {
namespace {

auto const home = geo::Wgs84::from_degrees(41.0, -8.0, 90.0);
constexpr auto square = "[[[-8.001,40.999],[-7.999,40.999],[-7.999,41.001],[-8.001,41.001],[-8.001,40.999]]]";

std::string feature(std::string const& geometry, std::string const& properties = "{}") {
  return fmt::format(R"({{"type":"Feature","properties":{},"geometry":{}}})", properties, geometry);
}
std::string polygon(std::string const& coordinates) {
  return fmt::format(R"({{"type":"Polygon","coordinates":{}}})", coordinates);
}

base::Result<Fence> read_fence(std::string_view geojson, geo::Wgs84 around) {
  auto const read = read_plan("a.geojson", geojson);
  if (!read) return std::unexpected(read.error());
  return level(read->plan.fence, around);
}

/// What people read, hint included.
std::string complaint(std::string const& geojson) {
  auto const fence = read_fence(geojson, home);
  if (fence) return "none";
  return fence.error().hint.empty() ? fence.error().message : fence.error().message + " | " + fence.error().hint;
}

TEST(GeoJsonFence, TakesACollectionWithProperties) {
  auto const text =
      fmt::format(R"({{"type":"FeatureCollection","features":[{},{}]}})",
                  feature(polygon(square), R"({"name":"field","max_height_m":50,"min_altitude_m":100})"),
                  feature(R"({"type":"Point","coordinates":[-8.0,41.0]})", R"({"fence":"exclusion","radius_m":30})"));
  auto const fence = read_fence(text, home);
  ASSERT_TRUE(fence) << fence.error().message;
  ASSERT_EQ(fence->zones.size(), 2U);
  auto const& field = fence->zones[0];
  EXPECT_EQ(field.name, "field");
  EXPECT_EQ(field.kind, Zone::Kind::inclusion);
  EXPECT_EQ(field.highest_m, 50.0);
  EXPECT_EQ(field.lowest_m, 10.0);
  ASSERT_EQ(field.polygons.size(), 1U);
  EXPECT_EQ(field.polygons[0].rings[0].size(), 4U);
  EXPECT_NEAR(field.polygons[0].rings[0][0].x(), -111.05, 0.1);
  EXPECT_NEAR(field.polygons[0].rings[0][0].y(), -84.11, 0.1);
  auto const& mast = fence->zones[1];
  EXPECT_EQ(mast.name, "zone 2");
  EXPECT_EQ(mast.kind, Zone::Kind::exclusion);
  EXPECT_TRUE(contains(mast.polygons[0], {0.0, 29.9}));
  EXPECT_FALSE(contains(mast.polygons[0], {0.0, 30.1}));
}

TEST(GeoJsonFence, TakesAFeatureAndABareGeometry) {
  EXPECT_TRUE(read_fence(feature(polygon(square)), home));
  EXPECT_TRUE(read_fence(polygon(square), home));
  EXPECT_TRUE(read_fence(R"({"type":"MultiPolygon","coordinates":[)" + std::string(square) + "]}", home));
  EXPECT_TRUE(read_fence(R"({"type":"Feature","properties":null,"geometry":)" + polygon(square) + "}", home));
}

TEST(GeoJsonFence, TakesHolesAndOpenRings) {
  auto const fence = read_fence(polygon("[[[-8.001,40.999],[-7.999,40.999],[-7.999,41.001],[-8.001,41.001]],"
                                        "[[-8.0001,40.9999],[-7.9999,40.9999],[-8,41.0001]]]"),
                                home);
  ASSERT_TRUE(fence);
  EXPECT_FALSE(contains(fence->zones[0].polygons[0], {0.0, 0.0}));
  EXPECT_TRUE(contains(fence->zones[0].polygons[0], {50.0, 50.0}));
}

TEST(GeoJsonFence, SaysWhereTheTextIsNoJson) {
  EXPECT_EQ(complaint("{\n\"type\":\n!").substr(0, 30), "a.geojson:3:1: this is no JSON");
  EXPECT_EQ(complaint(""), "a.geojson: the file is empty");
  EXPECT_NE(complaint(polygon("[[[1e999,0]]]")), "none");
}

TEST(GeoJsonFence, SaysWhereTheDocumentIsWrong) {
  EXPECT_EQ(complaint(R"({"type":"FeatureCollection"})"), "a.geojson: $: \"features\" is missing");
  EXPECT_EQ(complaint(R"({"type":"FeatureCollection","features":[]})"), "fence: there is no area in it");
  EXPECT_EQ(complaint(R"({"type":"FeatureCollection","features":[7]})"), "a.geojson: $.features[0]: is no Feature");
  EXPECT_EQ(complaint(R"({"type":"Feature"})"), "a.geojson: $: has no geometry");
  EXPECT_EQ(complaint(feature("null")), "a.geojson: $.geometry: is no GeoJSON geometry");
  EXPECT_EQ(complaint(feature(R"({"type":"Polygon"})")), "a.geojson: $.geometry.coordinates: an array is missing");
  EXPECT_EQ(complaint(polygon("[]")), "a.geojson: $.coordinates: there is no ring in it");
  EXPECT_EQ(complaint(polygon("[[[0,0],[1,1]]]")).substr(0, 32), "a.geojson: $.coordinates[0]: a r");
  EXPECT_EQ(complaint(polygon("[[[-8,41],[-8,41.1]]]")),
            "a.geojson: $.coordinates[0]: a ring needs at least three corners");
  EXPECT_EQ(complaint(polygon("[[[-8,41],[-8,41.1],7]]")),
            "a.geojson: $.coordinates[0][2]: is no position [longitude, latitude]");
}

TEST(GeoJsonFence, SaysWhatAPropertyShouldBe) {
  EXPECT_EQ(complaint(feature(polygon(square), R"({"fence":"wall"})")),
            "a.geojson: $.properties.fence: 'wall' is no kind of fence | use inclusion (stay inside, the default) or "
            "exclusion (stay outside)");
  EXPECT_EQ(complaint(feature(polygon(square), R"({"max_height_m":"high"})")),
            "a.geojson: $.properties.max_height_m: is no number of metres");
  EXPECT_EQ(complaint(feature(polygon(square), R"({"max_height_m":5,"max_altitude_m":95})")),
            "a.geojson: $.properties.max_altitude_m: says height and altitude: give one of them");
  EXPECT_EQ(complaint(feature(polygon(square), R"({"max_height_m":5,"min_height_m":6})")),
            "a.geojson: $.properties: the lower limit of height is not below the upper one");
  EXPECT_EQ(complaint(feature(R"({"type":"Point","coordinates":[-8,41]})", R"({"radius_m":"wide"})")),
            "a.geojson: $.properties.radius_m: is no radius, a number of metres");
}

TEST(GeoJsonFence, NoticesSwappedCoordinates) {
  EXPECT_EQ(complaint(polygon("[[[41,-8],[41.1,-8],[41,-8.1]]]")),
            "fence: zone 1: is 7381 km away from home | are latitude and longitude swapped? GeoJSON and KML write "
            "longitude first");
  EXPECT_EQ(
      complaint(polygon("[[[-8,138],[1,1],[2,2]]]")),
      "a.geojson: $.coordinates[0][0]: 138 is no latitude | GeoJSON writes longitude first: [longitude, latitude]");
}

TEST(GeoJsonFence, HasLimits) {
  std::string many = "[[";
  for (std::size_t i = 0; i <= max_fence_corners; ++i) many += fmt::format("{}[-8,41]", i ? "," : "");
  EXPECT_NE(complaint(polygon(many + "]]")).find("more than 10000 corners"), std::string::npos);
  EXPECT_NE(complaint(std::string(max_plan_bytes + 1, ' ')).find("too large"), std::string::npos);
  EXPECT_NE(complaint(std::string(1'000'000, '[')).find("no JSON"), std::string::npos);
}

std::string refusal(std::string const& geojson, PlanReadOptions const& options = {}) {
  auto const read = read_plan("a.geojson", geojson, options);
  if (read) return "none";
  return read.error().hint.empty() ? read.error().message : read.error().message + " | " + read.error().hint;
}

TEST(GeoJsonMission, IsDrawnWithPointsAndLines) {
  auto const text =
      fmt::format(R"({{"type":"FeatureCollection","features":[{},{},{},{}]}})",
                  feature(R"({"type":"Point","coordinates":[-8,41,120]})"),
                  feature(R"({"type":"LineString","coordinates":[[-8,41.1,50],[-8,41.2,60]]})", R"({"frame":3})"),
                  feature(R"({"type":"Point","coordinates":[-8,41.3,9]})", R"({"role":"home"})"),
                  feature(R"({"type":"Point","coordinates":[-8,41.4,20]})", R"({"role":"rally"})"));
  auto const read = read_plan("north.geojson", text);
  ASSERT_TRUE(read) << read.error().message;
  auto const& mission = read->plan.mission;
  EXPECT_EQ(mission.name, "north");
  ASSERT_EQ(mission.items.size(), 3u);
  EXPECT_EQ(mission.items[0].frame, mavlink::MavFrame::global);
  EXPECT_EQ(mission.items[0].place.z_m, 120.0);
  EXPECT_EQ(mission.items[2].frame, mavlink::MavFrame::global_relative_alt);
  EXPECT_NEAR(position_of(mission.items[2]).lat_deg(), 41.2, 1e-12);
  EXPECT_EQ(mission.planned_home->alt_m, 9.0);
  ASSERT_EQ(read->plan.rally.size(), 1u);
}

TEST(GeoJsonMission, NeedsHeights) {
  auto const text = feature(R"({"type":"Point","coordinates":[-8,41]})");
  EXPECT_EQ(refusal(text),
            "a.geojson: $.geometry.coordinates: this place has no height to fly at | say one: --altitude METRES above "
            "home");
  auto const read = read_plan("a.geojson", text, {.altitude_m = 30.0});
  ASSERT_TRUE(read);
  EXPECT_EQ(read->plan.mission.items[0].frame, mavlink::MavFrame::global_relative_alt);
  EXPECT_EQ(read->plan.mission.items[0].place.z_m, 30.0);
}

TEST(GeoJsonMission, SaysWhereAnItemIsWrong) {
  auto const item = [](std::string const& geometry, std::string const& properties) {
    return refusal(feature(geometry, properties));
  };
  constexpr auto there = R"({"type":"Point","coordinates":[-8,41,9]})";
  EXPECT_EQ(item(there, R"({"command":"16"})"), "a.geojson: $.properties.command: a number was expected");
  EXPECT_EQ(item(there, R"({"command":16,"frame":3})"), "a.geojson: $.properties: \"params\" is missing");
  EXPECT_EQ(item(there, R"({"command":65000,"frame":3,"params":[]})"),
            "a.geojson: $.geometry: command 65000 is not known here");
  EXPECT_EQ(item(R"({"type":"Point","coordinates":[-8,41]})", R"({"command":16,"frame":3,"params":[]})"),
            "a.geojson: $.geometry.coordinates: an item with a command needs its height, the third number");
  EXPECT_EQ(item("null", R"({"command":177,"frame":2,"params":[9,1,0,0,0,0,0]})"),
            "a.geojson: item 1: the jump leads to item 9, which is not there");
  EXPECT_EQ(item("null", R"({"role":"pattern","first":1,"count":2,"source":{"type":"ComplexItem"}})"),
            "a.geojson: $.properties: the items of a pattern come before it, and belong to no other pattern");
  EXPECT_EQ(item(there, R"({"role":"hangar"})"),
            "a.geojson: $.properties.role: 'hangar' is no role of a point | roles are home, rally and breach_return");
  EXPECT_EQ(
      refusal(R"({"type":"GeometryCollection","coordinates":[]})"),
      "a.geojson: $.type: a GeometryCollection is no part of a plan | plans are made of Point, LineString, Polygon "
      "and MultiPolygon");
}

}  // namespace
}  // namespace lapwing::plan
