#include "plan/fence_geojson.hpp"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

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

/// What people read, hint included.
std::string complaint(std::string const& geojson) {
  auto const fence = read_fence(geojson, home);
  if (fence) return "none";
  return fence.error().hint.empty() ? fence.error().message : fence.error().message + " | " + fence.error().hint;
}

TEST(ReadFence, TakesACollectionWithProperties) {
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
  EXPECT_NEAR(field.polygons[0].rings[0][0].north_m, -111.05, 0.1);
  EXPECT_NEAR(field.polygons[0].rings[0][0].east_m, -84.11, 0.1);
  auto const& mast = fence->zones[1];
  EXPECT_EQ(mast.name, "zone 2");
  EXPECT_EQ(mast.kind, Zone::Kind::exclusion);
  EXPECT_TRUE(contains(mast.polygons[0], {0.0, 29.9}));
  EXPECT_FALSE(contains(mast.polygons[0], {0.0, 30.1}));
}

TEST(ReadFence, TakesAFeatureAndABareGeometry) {
  EXPECT_TRUE(read_fence(feature(polygon(square)), home));
  EXPECT_TRUE(read_fence(polygon(square), home));
  EXPECT_TRUE(read_fence(R"({"type":"MultiPolygon","coordinates":[)" + std::string(square) + "]}", home));
  EXPECT_TRUE(read_fence(R"({"type":"Feature","properties":null,"geometry":)" + polygon(square) + "}", home));
}

TEST(ReadFence, TakesHolesAndOpenRings) {
  auto const fence = read_fence(polygon("[[[-8.001,40.999],[-7.999,40.999],[-7.999,41.001],[-8.001,41.001]],"
                                        "[[-8.0001,40.9999],[-7.9999,40.9999],[-8,41.0001]]]"),
                                home);
  ASSERT_TRUE(fence);
  EXPECT_FALSE(contains(fence->zones[0].polygons[0], {0.0, 0.0}));
  EXPECT_TRUE(contains(fence->zones[0].polygons[0], {50.0, 50.0}));
}

TEST(ReadFence, SaysWhereTheTextIsNoJson) {
  EXPECT_EQ(complaint("{\n\"type\":\n!"), "fence: line 3: this is no JSON");
  EXPECT_EQ(complaint(""), "fence: line 1: this is no JSON");
  EXPECT_NE(complaint(polygon("[[[1e999,0]]]")), "none");
}

TEST(ReadFence, SaysWhereTheDocumentIsWrong) {
  EXPECT_EQ(complaint("[]"), "fence: $: is no GeoJSON geometry");
  EXPECT_EQ(complaint(R"({"type":"FeatureCollection"})"), "fence: $.features: an array is missing");
  EXPECT_EQ(complaint(R"({"type":"FeatureCollection","features":[]})"), "fence: $: there is no area in it");
  EXPECT_EQ(complaint(R"({"type":"FeatureCollection","features":[7]})"), "fence: $.features[0]: is no Feature");
  EXPECT_EQ(complaint(R"({"type":"Feature"})"), "fence: $: has no geometry");
  EXPECT_EQ(complaint(feature("null")), "fence: $.geometry: is no GeoJSON geometry");
  EXPECT_EQ(complaint(feature(R"({"type":"Polygon"})")), "fence: $.geometry.coordinates: an array is missing");
  EXPECT_EQ(complaint(polygon("[]")), "fence: $.coordinates: there is no ring in it");
  EXPECT_EQ(complaint(polygon("[[[0,0],[1,1]]]")).substr(0, 28), "fence: $.coordinates[0][0]: ");
  EXPECT_EQ(complaint(polygon("[[[-8,41],[-8,41.1]]]")),
            "fence: $.coordinates[0]: a ring needs at least three corners");
  EXPECT_EQ(complaint(polygon("[[[-8,41],[-8,41.1],7]]")),
            "fence: $.coordinates[0][2]: is no position [longitude, latitude]");
}

TEST(ReadFence, SaysWhatAPropertyShouldBe) {
  EXPECT_EQ(complaint(feature(polygon(square), R"({"fence":"wall"})")),
            "fence: $.properties.fence: 'wall' is no kind of fence | use inclusion (stay inside, the default) or "
            "exclusion (stay outside)");
  EXPECT_EQ(complaint(feature(polygon(square), R"({"max_height_m":"high"})")),
            "fence: $.properties.max_height_m: is no number of metres");
  EXPECT_EQ(complaint(feature(polygon(square), R"({"max_height_m":5,"max_altitude_m":95})")),
            "fence: $.properties.max_altitude_m: says height and altitude: give one of them");
  EXPECT_EQ(complaint(feature(polygon(square), R"({"max_height_m":5,"min_height_m":6})")),
            "fence: $.properties: the lower limit of height is not below the upper one");
  EXPECT_EQ(complaint(feature(R"({"type":"Point","coordinates":[-8,41]})")),
            "fence: $.geometry.coordinates: a Point needs the property radius_m, a number of metres");
  EXPECT_EQ(complaint(feature(R"({"type":"LineString","coordinates":[]})")),
            "fence: $.geometry.type: LineString encloses no area | a fence is made of Polygon, MultiPolygon, or Point "
            "with the property radius_m");
}

TEST(ReadFence, NoticesSwappedCoordinates) {
  EXPECT_EQ(complaint(polygon("[[[41,-8],[41.1,-8],[41,-8.1]]]")),
            "fence: $.coordinates[0][0]: is 7381 km away from home | GeoJSON writes longitude first: [longitude, "
            "latitude]");
  EXPECT_EQ(complaint(polygon("[[[-8,138],[1,1],[2,2]]]")),
            "fence: $.coordinates[0][0]: 138 is no latitude | GeoJSON writes longitude first: [longitude, latitude]");
}

TEST(ReadFence, HasLimits) {
  std::string many = "[[";
  for (std::size_t i = 0; i <= max_fence_corners; ++i) many += fmt::format("{}[-8,41]", i ? "," : "");
  EXPECT_NE(complaint(polygon(many + "]]")).find("more than 10000 corners"), std::string::npos);
  EXPECT_NE(complaint(std::string(max_fence_bytes + 1, ' ')).find("too large"), std::string::npos);
  EXPECT_NE(complaint(std::string(1'000'000, '[')).find("no JSON"), std::string::npos);
}

}  // namespace
}  // namespace lapwing::plan
