#include "map/features/properties.hpp"

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "map/testing/random_features.hpp"

namespace lapwing::map {
namespace {

using namespace std::chrono_literals;

class OfEveryLayer : public ::testing::TestWithParam<LayerKind> {};

INSTANTIATE_TEST_SUITE_P(Properties, OfEveryLayer, ::testing::ValuesIn(all_layers),
                         [](auto const& layer) { return std::string(name_of(layer.param)); });

TEST_P(OfEveryLayer, AndGeometryAreTheWholeContent) {
  testing::RandomFeatures random(11);
  std::mt19937_64 order_of(12);
  std::vector<Property const*> order;
  for (auto const& property : properties_of(GetParam())) order.push_back(&property);
  for (int i = 0; i < 200; ++i) {
    auto const content = random.content(GetParam());
    auto again = content_at(GetParam(), geometry_of(content));
    ASSERT_TRUE(again) << again.error().message;
    std::ranges::shuffle(order, order_of);
    for (auto const* property : order) {
      auto const set = property->set(*again, property->get(content));
      ASSERT_TRUE(set) << property->name << " " << set.error().message;
    }
    ASSERT_EQ(*again, content);
    EXPECT_EQ(layer_of(*again), GetParam());
  }
}

TEST_P(OfEveryLayer, AreTakenAwayByNothing) {
  testing::RandomFeatures random(13);
  for (int i = 0; i < 50; ++i) {
    auto content = random.content(GetParam());
    for (auto const& property : properties_of(GetParam())) ASSERT_TRUE(property.set(content, {})) << property.name;
    auto const fresh = *content_at(GetParam(), geometry_of(content));
    for (auto const& property : properties_of(GetParam())) {
      if (property.name == "media_type") continue;  // a picture has one: JPEG where nothing else is told
      EXPECT_EQ(property.get(content), property.get(fresh)) << property.name;
    }
  }
}

TEST_P(OfEveryLayer, HaveNamesOfTheirOwnThatEveryTableCanHave) {
  std::set<std::string_view> names = {"id",        "site",     "floor", "writer",  "at",
                                      "held_over", "geometry", "geom",  "revision"};
  for (auto const& property : properties_of(GetParam())) {
    EXPECT_TRUE(names.insert(property.name).second) << property.name;
    EXPECT_EQ(property.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string_view::npos);
    EXPECT_LT(property.name.size(), 32U);
    EXPECT_EQ(property_named(GetParam(), property.name), &property);
    EXPECT_TRUE(property.words.empty() || property.kind == PropertyKind::text);
  }
  EXPECT_EQ(property_named(GetParam(), "nonsense"), nullptr);
}

TEST_P(OfEveryLayer, RefuseOtherKindsOfValues) {
  testing::RandomFeatures random(14);
  for (auto const& property : properties_of(GetParam())) {
    auto content = random.content(GetParam());
    auto const before = content;
    auto const refused = property.set(content, true);
    ASSERT_FALSE(refused) << property.name;
    EXPECT_EQ(refused.error().kind, base::ErrorKind::invalid_input);
    EXPECT_TRUE(refused.error().message.starts_with("takes ")) << refused.error().message;
    EXPECT_EQ(content, before) << property.name;
  }
}

TEST(LayerKind, HasAName) {
  for (auto const layer : all_layers) EXPECT_EQ(layer_named(name_of(layer)), layer);
  EXPECT_EQ(layer_named("grids"), std::nullopt);
}

base::Result<> set(Content& content, std::string_view name, PropertyValue const& value) {
  return property_named(layer_of(content), name)->set(content, value);
}

TEST(Properties, TakeOneOfTheirWords) {
  Content slot = Slot();
  EXPECT_TRUE(set(slot, "state", "taken"));
  EXPECT_EQ(std::get<Slot>(slot).state, SlotState::taken);
  auto const refused = set(slot, "state", "occupied");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "takes one of the words unknown, free, taken");
}

TEST(Properties, TakeNumbersHoweverTheyAreWritten) {
  Content wall = Wall();
  EXPECT_TRUE(set(wall, "height_m", std::int64_t{3}));
  EXPECT_EQ(std::get<Wall>(wall).height_m, 3.0);
  EXPECT_FALSE(set(wall, "height_m", std::numeric_limits<double>::quiet_NaN()));
  Content picture = Picture();
  EXPECT_TRUE(set(picture, "width_px", 640.0));
  EXPECT_EQ(std::get<Picture>(picture).width_px, 640);
  EXPECT_FALSE(set(picture, "width_px", 640.5));
  EXPECT_FALSE(set(picture, "width_px", 1e300));
  EXPECT_FALSE(set(picture, "width_px", std::int64_t{1} << 40));
}

TEST(Properties, TellThePlaceOfACameraOnlyBesideItsFootprint) {
  Content picture = Picture{.position = {3.0, 4.0}};
  EXPECT_EQ(property_named(LayerKind::pictures, "camera_x_m")->get(picture), PropertyValue());
  auto const refused = set(picture, "camera_x_m", 1.0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "takes nothing where the geometry is the place of the camera itself");
}

TEST(Properties, OfATrackHaveOneNumberAPoint) {
  LineString const line{{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}};
  auto track = *content_at(LayerKind::tracks, line);
  EXPECT_EQ(set(track, "times_s", "0 1").error().message, "has 2 numbers, and the track 3 points");
  EXPECT_EQ(set(track, "times_s", "1 2 3").error().message,
            "takes times since the first point, the first of which is 0");
  EXPECT_EQ(set(track, "times_s", "0 x 3").error().message, "takes seconds with blanks between");
  EXPECT_EQ(set(track, "times_s", "0 1 9999999999").error().message, "takes seconds with blanks between");
  EXPECT_EQ(set(track, "ups_m", "0 nan 3").error().message, "takes metres with blanks between");
  EXPECT_EQ(set(track, "began_at", base::UtcTime(-9'000'000'000s)).error().message, "takes a time from 1990 to 2200");
  EXPECT_TRUE(set(track, "times_s", "0 0.5 1.000000001"));
  auto const began = base::UtcTime(1'795'255'972s);
  EXPECT_TRUE(set(track, "began_at", began));
  EXPECT_EQ(std::get<Track>(track).samples[2].at, began + 1s + 1ns);
}

TEST(Properties, TurnFootprintsAsPicturesGo) {
  SitePolygon const turned{{{{0.0, 10.0}, {0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}}}};
  auto const picture = std::get<Picture>(*content_at(LayerKind::pictures, turned));
  EXPECT_EQ(picture.footprint, (std::vector<SitePoint>{{0.0, 10.0}, {10.0, 10.0}, {10.0, 0.0}, {0.0, 0.0}}));
}

TEST(Properties, RefuseTheGeometryOfAnotherLayer) {
  Geometry const point = SitePoint();
  Geometry const line = LineString{{{}, {}}};
  Geometry const polygon = SitePolygon{{{{}, {}, {}}}};
  Geometry const holed = SitePolygon{{{{}, {}, {}}, {{}, {}, {}}}};
  auto const refuses = [](LayerKind layer, Geometry const& geometry) {
    auto const content = content_at(layer, geometry);
    return !content && content.error().kind == base::ErrorKind::invalid_input;
  };
  EXPECT_EQ(content_at(LayerKind::slots, line).error().message, "the layer slots takes polygons");
  EXPECT_TRUE(refuses(LayerKind::areas, point));
  EXPECT_TRUE(refuses(LayerKind::walls, polygon));
  EXPECT_TRUE(refuses(LayerKind::points_of_interest, polygon));
  EXPECT_TRUE(refuses(LayerKind::tracks, point));
  EXPECT_TRUE(refuses(LayerKind::pictures, line));
  EXPECT_TRUE(refuses(LayerKind::pictures, holed));
}

}  // namespace
}  // namespace lapwing::map
