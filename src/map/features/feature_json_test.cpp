#include "map/features/feature_json.hpp"

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "base/testing/cpu_time.hpp"
#include "map/testing/random_features.hpp"

namespace lapwing::map {
namespace {

using namespace std::chrono_literals;

constexpr auto now = base::UtcTime(1'795'255'972s);

geo::Site site_at(double lat_deg, double lon_deg) {
  return *geo::Site::make("yard", geo::Wgs84::from_degrees(lat_deg, lon_deg, 90.0));
}

base::Result<std::vector<Feature>> read(std::string const& text, LayerKind layer = LayerKind::slots,
                                        geo::Site const& site = site_at(41.0, -8.0)) {
  return read_features(text, layer, [&](std::string_view id) { return id == "yard" ? &site : nullptr; },
                       {.id = "new", .site = "yard", .account = {"operator", now}});
}

std::string error_of(std::string const& text, LayerKind layer = LayerKind::slots) {
  auto const features = read(text, layer);
  return features ? "none" : features.error().message;
}

std::string feature_text(std::string const& geometry, std::string const& properties = "{}") {
  return R"({"type":"Feature","id":"s1","geometry":)" + geometry + R"(,"properties":)" + properties + "}";
}

constexpr auto triangle = R"({"type":"Polygon","coordinates":[[[-8,41],[-7.9999,41],[-8,41.0001],[-8,41]]]})";

SitePoint first_point(Geometry const& geometry) {
  if (auto const* point = std::get_if<SitePoint>(&geometry)) return *point;
  if (auto const* line = std::get_if<LineString>(&geometry)) return line->points.front();
  return std::get<SitePolygon>(geometry).rings.front().front();
}

class FeatureJsonOf : public ::testing::TestWithParam<LayerKind> {};

INSTANTIATE_TEST_SUITE_P(Layers, FeatureJsonOf, ::testing::ValuesIn(all_layers),
                         [](auto const& layer) { return std::string(name_of(layer.param)); });

TEST_P(FeatureJsonOf, IsReadAsItWasWritten) {
  testing::RandomFeatures random(40);
  for (auto const& site : {site_at(41.0, -8.0), site_at(-17.0, 180.0), site_at(60.0, -179.999)}) {
    for (int i = 0; i < 60; ++i) {
      auto feature = random.feature(GetParam(), "f1", "yard");
      if (GetParam() == LayerKind::slots && i % 2 == 0) {
        std::get<Slot>(feature.content).name = "221";
        feature.held_over = {{"name", {"drone \"2\"", now}}};
      }
      auto const json = feature_json(feature, site);
      auto const again = read(json.dump(), GetParam(), site);
      ASSERT_TRUE(again) << again.error().message << json;
      ASSERT_EQ(again->size(), 1U);
      EXPECT_LT(
          geo::distance_m(first_point(geometry_of(again->front().content)), first_point(geometry_of(feature.content))),
          2e-4);
      for (auto const& property : properties_of(GetParam()))
        EXPECT_EQ(property.get(again->front().content), property.get(feature.content)) << property.name;
      EXPECT_EQ(again->front().account, feature.account);
      EXPECT_EQ(again->front().held_over, feature.held_over);
      EXPECT_EQ(feature_json(again->front(), site), json) << "written again it is the same";
    }
  }
}

TEST(FeatureJson, IsAGeoJsonFeature) {
  Feature const feature{
      .id = "s1",
      .site = "yard",
      .floor = "1",
      .account = {"drone 1", now},
      .content =
          Slot{.outline = {{{{0.0, 0.0}, {0.0, 5.0}, {2.0, 5.0}, {2.0, 0.0}}, {{0.5, 0.5}, {1.0, 0.5}, {1.0, 1.0}}}},
               .state = SlotState::taken,
               .seen_at = now - 1s}};
  auto const json = feature_json(feature, site_at(41.0, -8.0));
  EXPECT_EQ(json["type"], "Feature");
  EXPECT_EQ(json["id"], "s1");
  EXPECT_EQ(json["properties"].dump(),
            R"({"site":"yard","floor":"1","writer":"drone 1","at":"2026-11-21T10:12:52.000Z",)"
            R"("state":"taken","seen_at":"2026-11-21T10:12:51.000Z"})");
  EXPECT_EQ(json["geometry"].dump(),
            R"({"type":"Polygon","coordinates":[[[-8.0,41.0],[-7.999976229,41.0],[-7.999976229,41.000045023],)"
            R"([-8.0,41.000045023],[-8.0,41.0]],[[-7.999994057,41.000004502],[-7.999988115,41.000009005],)"
            R"([-7.999988115,41.000004502],[-7.999994057,41.000004502]]]})")
      << "the outer ring counterclockwise, the hole clockwise";
}

TEST(FeatureJson, GoesOnBeyondTheAntimeridian) {
  auto const site = site_at(10.0, 179.9999);
  auto const json = geometry_json(LineString{{{-100.0, 0.0}, {100.0, 0.0}}}, site);
  EXPECT_LT(json["coordinates"][0][0], 180.0);
  EXPECT_GT(json["coordinates"][1][0], 180.0);
  auto const west = R"({"type":"LineString","coordinates":[[179.9995,10],[-179.9995,10]]})";
  auto const walls = read(feature_text(west), LayerKind::walls, site);
  ASSERT_TRUE(walls) << walls.error().message;
  auto const& points = std::get<Wall>(walls->front().content).line.points;
  EXPECT_NEAR(geo::distance_m(points[0], points[1]), 109.6, 0.1) << "not round the globe";
}

TEST(FeatureJson, TakesWhatOthersWrite) {
  auto const slots =
      read(R"({"type":"FeatureCollection","name":"x","features":[{"type":"Feature","id":7,"properties":null,"geometry":
    {"type":"MultiPolygon","coordinates":[[[[-8,41,3],[-7.9999,41,3],[-8,41.0001,3],[-8,41,3]]]]}}]})");
  ASSERT_TRUE(slots) << slots.error().message;
  EXPECT_EQ(slots->front().id, "7");
  EXPECT_EQ(slots->front().account, (Account{"operator", now}));
  EXPECT_EQ(
      read(R"({"type":"Feature","properties":{"name":null},"geometry":)" + std::string(triangle) + "}")->front().id,
      "new");
}

TEST(FeatureJson, IsRefusedWithThePlace) {
  EXPECT_EQ(error_of("{"), "this is no JSON");
  EXPECT_EQ(error_of("[]"), "the document is no GeoJSON Feature");
  EXPECT_EQ(error_of(R"({"type":"FeatureCollection"})"), "the FeatureCollection has no list of features");
  EXPECT_EQ(error_of(R"({"type":"FeatureCollection","features":[7]})"), "features[0] is no GeoJSON Feature");
  EXPECT_EQ(error_of(std::string(2'000, '[')), "this is no JSON");
  EXPECT_EQ(error_of(R"({"type":"Feature"})"), "the document has no geometry");
  EXPECT_EQ(error_of(feature_text(R"({"type":"Point"})")), "geometry has no coordinates");
  EXPECT_EQ(error_of(feature_text(R"({"type":"Circle","coordinates":[]})")),
            "geometry is \"Circle\", not a Point, LineString or Polygon");
  EXPECT_EQ(error_of(feature_text(R"({"type":"Polygon","coordinates":[[[-8,41],[-8,42],[-8,95],[-8,41]]]})")),
            "geometry.coordinates[0][2][1] is 95, not a latitude");
  EXPECT_EQ(error_of(R"({"type":"FeatureCollection","features":[)" + feature_text(triangle) + "," +
                     feature_text(R"({"type":"Polygon","coordinates":[[[-8,41],["a",42],[-8,42],[-8,41]]]})") + "]}"),
            "features[1].geometry.coordinates[0][1][0] is \"a\", not a number");
  EXPECT_EQ(error_of(feature_text(R"({"type":"Polygon","coordinates":[[[-8,41],[-8,42],[-7,41],[-7,42]]]})")),
            "geometry.coordinates[0] is not closed");
  EXPECT_EQ(error_of(feature_text(R"({"type":"Polygon","coordinates":[[1,2,3,1]]})")),
            "geometry.coordinates[0][0] is 1, not [longitude, latitude]");
  EXPECT_EQ(error_of(feature_text(R"({"type":"MultiPolygon","coordinates":[[],[]]})")),
            "geometry has several parts; a feature has one");
  EXPECT_EQ(error_of(feature_text(R"({"type":"Point","coordinates":[-8,41]})")),
            "geometry: the layer slots takes polygons");
  EXPECT_EQ(error_of(feature_text(R"({"type":"Point","coordinates":[-8,51]})"), LayerKind::points_of_interest),
            "geometry: point 1 of the place lies 1123 km from the site's anchor; the map of a site ends at 100 km");
  EXPECT_EQ(error_of(feature_text(
                R"({"type":"Polygon","coordinates":[[[-8,41],[-7.9999,41.0001],[-7.9999,41],[-8,41.0001],[-8,41]]]})")),
            "geometry: its edges cross or touch each other");
}

TEST(FeatureJson, IsRefusedForItsProperties) {
  EXPECT_EQ(error_of(feature_text(triangle, R"({"site":"moon"})")), "the document: there is no site \"moon\"");
  EXPECT_EQ(read(feature_text(triangle, R"({"site":"moon"})")).error().kind, base::ErrorKind::not_found);
  EXPECT_EQ(error_of(feature_text(triangle, R"({"state":"occupied"})")),
            "properties.state takes one of the words unknown, free, taken");
  EXPECT_EQ(error_of(feature_text(triangle, R"({"seen_at":"yesterday"})")),
            "properties.seen_at is \"yesterday\", not a time as 2026-11-21T10:12:52Z");
  EXPECT_EQ(error_of(feature_text(triangle, R"({"at":1})")), "properties.at is 1, not text");
  EXPECT_EQ(error_of(feature_text(triangle, R"({"name":["a"]})")), "properties.name is a list, not a plain value");
  EXPECT_EQ(error_of(feature_text(triangle, R"({"taken_probability":1.5})")),
            "the document: taken_probability is 1.5, not from 0 to 1");
  auto const typo = read(feature_text(triangle, R"({"stat":"free"})"));
  EXPECT_EQ(typo.error().message, "properties: the layer slots has no property \"stat\"");
  EXPECT_EQ(typo.error().hint, "did you mean state?");
  EXPECT_EQ(error_of(feature_text(triangle, R"({"held_over":[{"property":"name","at":"x"}]})")),
            "properties.held_over[0].at is \"x\", not a time as 2026-11-21T10:12:52Z");
}

TEST(FeatureJson, IsRefusedAtOnceWhenItIsHuge) {
  EXPECT_EQ(error_of(std::string(most_json_bytes + 1, ' ')),
            "it has 16777217 bytes; at most 16777216 are taken at once");
  std::string ring = "[0,0]";
  for (int i = 0; i < 1'000'000; ++i) ring += ",[0,0]";
  auto const began = base::cpu_time();
  EXPECT_EQ(error_of(feature_text(R"({"type":"Polygon","coordinates":[[)" + ring + "]]}")),
            "geometry.coordinates[0] has 1000001 points; at most 10001 are taken");
  EXPECT_LT(base::cpu_time() - began, 30s) << "with a sanitizer on a busy machine";
  std::string features = "{}";
  for (std::size_t i = 0; i < most_json_features; ++i) features += ",{}";
  EXPECT_EQ(error_of(R"({"type":"FeatureCollection","features":[)" + features + "]}"),
            "there are 10001 features; at most 10000 are taken at once");
}

TEST(HeldOver, IsAText) {
  std::vector<HeldOver> const held = {{"name", {"drone \"2\"; x", now}}, {"text", {"b", now + 1ns}}};
  EXPECT_EQ(held_over_of(held_over_text(held)), held);
  EXPECT_EQ(held_over_text({}), "");
  EXPECT_EQ(held_over_of(""), std::vector<HeldOver>());
  EXPECT_EQ(held_over_of("{}").error().message, "held_over is no list, or a long one");
  EXPECT_EQ(held_over_of("x").error().message, "held_over is no JSON");
}

}  // namespace
}  // namespace lapwing::map
