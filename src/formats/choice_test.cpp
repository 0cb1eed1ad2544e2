// Which part of a map goes into a file, also across the antimeridian.
#include "formats/choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace lapwing::formats {
namespace {

map::Feature door(std::string id, std::string site, std::string floor, double x, double y) {
  return {.id = std::move(id),
          .site = std::move(site),
          .floor = std::move(floor),
          .account = {.writer = "1", .at = base::UtcTime(std::chrono::hours(500'000))},
          .content = map::PointOfInterest{.position = map::SitePoint(x, y)}};
}

struct ChoiceTest : ::testing::Test {
  MapContents contents;
  void SetUp() override {
    contents.sites.emplace("yard", geo::Site::make("yard", geo::Wgs84::from_degrees(41.0, -8.0)).value());
    contents.sites.emplace("isle", geo::Site::make("isle", geo::Wgs84::from_degrees(-17.0, 179.9999)).value());
    contents.features = {door("near", "yard", "", 0.0, 0.0), door("far", "yard", "1", 5'000.0, 0.0),
                         door("beyond the line", "isle", "", 100.0, 0.0)};
    contents.features.push_back({.id = "wall",
                                 .site = "yard",
                                 .account = contents.features[0].account,
                                 .content = map::Wall{.line = {{map::SitePoint(-50, 0), map::SitePoint(50, 0)}}}});
    map::OccupancyGrid grid(0.1);
    grid.set({1, 1}, map::Evidence::of_probability(0.9));
    contents.grids.emplace(map::GridKey{"yard", "1", "floor"}, grid);
  }
  [[nodiscard]] std::vector<std::string> ids(Choice const& choice) const {
    std::vector<std::string> ids;
    for (auto const& feature : chosen_of(contents, choice).features) ids.push_back(feature.id);
    return ids;
  }
};

using Ids = std::vector<std::string>;

TEST_F(ChoiceTest, WithoutAnyAllOfItIsThere) {
  auto const all = chosen_of(contents, {});
  EXPECT_EQ(all.features.size(), 4U);
  EXPECT_EQ(all.grids.size(), 1U);
  EXPECT_EQ(all.sites.size(), 2U);
}

TEST_F(ChoiceTest, ByLayerSiteAndFloor) {
  EXPECT_EQ(ids({.layers = {map::LayerKind::walls}}), Ids({"wall"}));
  EXPECT_EQ(ids({.layers = {map::LayerKind::walls, map::LayerKind::areas}}), Ids({"wall"}));
  EXPECT_EQ(ids({.site = "isle"}), Ids({"beyond the line"}));
  EXPECT_EQ(ids({.site = "yard", .floor = "1"}), Ids({"far"}));
  EXPECT_EQ(chosen_of(contents, {.site = "isle"}).sites.size(), 1U);
  EXPECT_TRUE(chosen_of(contents, {.site = "isle"}).grids.empty());
}

TEST_F(ChoiceTest, WithinABoxWhatLiesInItInPart) {
  DegreeBox const east_of_anchor{-7.9997, 40.999, -7.9, 41.001};
  EXPECT_EQ(ids({.within = east_of_anchor}), Ids({"far", "wall"}));
  EXPECT_TRUE(chosen_of(contents, {.within = DegreeBox{1, 1, 2, 2}}).grids.empty());
  EXPECT_EQ(chosen_of(contents, {.within = DegreeBox{-8.1, 40.9, -7.9, 41.1}}).grids.size(), 1U);
}

TEST_F(ChoiceTest, WithinABoxBeyondTheAntimeridian) {
  EXPECT_EQ(ids({.within = DegreeBox{-180.0, -18.0, -179.9, -16.0}}), Ids({"beyond the line"}));
  EXPECT_EQ(ids({.within = DegreeBox{179.5, -18.0, -179.5, -16.0}}), Ids({"beyond the line"}));
  EXPECT_EQ(ids({.within = DegreeBox{-179.9, -18.0, 179.0, -16.0}}), Ids());
}

}  // namespace
}  // namespace lapwing::formats
