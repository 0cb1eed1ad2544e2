#include "plan/survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::plan {
namespace {

using geo::Wgs84;

auto const base_place = Wgs84::from_degrees(40.0, -8.0, 100.0);

/// The path in metres about its base.
std::vector<geo::Ned> metres(SurveyArea const& area) {
  geo::LocalFrame const frame(area.base);
  std::vector<geo::Ned> points;
  auto const path = survey_path(area);
  EXPECT_TRUE(path) << path.error().message;
  for (auto const& place : *path) points.push_back(frame.ned_from(place));
  return points;
}

struct SizeCase {
  double length_m, width_m, spacing_m;
  int legs;
};

TEST(Survey, HasTheLegsOfTheSpecification) {
  for (auto const& [length_m, width_m, spacing_m, legs] :
       {SizeCase{3000, 10000, 500, 21}, SizeCase{1000, 1000, 100, 11}, SizeCase{3000, 2000, 500, 5},
        SizeCase{1000, 150, 50, 4}}) {
    SurveyArea const area{.base = base_place, .length_m = length_m, .width_m = width_m, .spacing_m = spacing_m};
    EXPECT_EQ(leg_count(area), legs);
    EXPECT_EQ(survey_path(area)->size(), static_cast<std::size_t>(2 * legs + 1));
  }
}

TEST(Survey, ShortensTheLastGapInsteadOfLeavingAWideOne) {
  auto const points = metres({.base = base_place, .length_m = 100, .width_m = 120, .spacing_m = 50});
  ASSERT_EQ(points.size(), 9u);
  EXPECT_NEAR(points[5].east, -100.0, 0.01);
  EXPECT_NEAR(points[6].east, -120.0, 0.01);
}

TEST(Survey, OfAreaNarrowerThanTheSpacingFliesBothEdges) {
  auto const points = metres({.base = base_place, .length_m = 100, .width_m = 10, .spacing_m = 50});
  ASSERT_EQ(points.size(), 5u);
  EXPECT_NEAR(points[3].east, -10.0, 0.01);
}

TEST(Survey, CountsLegsOfInexactDecimals) {
  EXPECT_EQ(leg_count({.base = {}, .length_m = 1, .width_m = 0.3, .spacing_m = 0.1}), 4);
  EXPECT_EQ(leg_count({.base = {}, .length_m = 1, .width_m = 2.1, .spacing_m = 0.7}), 4);
}

TEST(Survey, LiesInTheDirectionAsked) {
  using enum SurveyDirection;
  for (auto const& [direction, north, east] : {std::tuple{north_east, 1, 1}, std::tuple{north_west, 1, -1},
                                               std::tuple{south_east, -1, 1}, std::tuple{south_west, -1, -1}}) {
    auto const points = metres({.base = base_place, .length_m = 200, .width_m = 100, .direction = direction});
    EXPECT_NEAR(points[1].north, north * 225.0, 0.01);
    EXPECT_NEAR(points[3].north, -north * 25.0, 0.01);
    EXPECT_NEAR(points[3].east, east * 50.0, 0.01);
  }
}

TEST(Survey, OvershootIsAnOption) {
  auto const points = metres({.base = base_place, .length_m = 200, .width_m = 50, .overshoot_m = 0.0});
  EXPECT_NEAR(points[1].north, 200.0, 0.01);
  EXPECT_NEAR(points[3].north, 0.0, 0.01);
}

TEST(Survey, OfAnySizeCoversItsWidthAtItsBasesHeightAndComesBack) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> lengths(1.0, 5000.0);
  std::uniform_real_distribution<double> spacings(5.0, 300.0);
  std::uniform_int_distribution<int> directions(0, 3);
  for (int trial = 0; trial < 100; ++trial) {
    SurveyArea const area{.base = Wgs84::from_degrees(-33.0, 151.0, 55.5),
                          .length_m = lengths(random),
                          .width_m = lengths(random),
                          .spacing_m = spacings(random),
                          .direction = static_cast<SurveyDirection>(directions(random))};
    auto const path = survey_path(area);
    ASSERT_TRUE(path);
    ASSERT_EQ(path->size(), static_cast<std::size_t>(2 * leg_count(area) + 1));
    EXPECT_EQ(path->front(), area.base);
    EXPECT_EQ(path->back(), area.base);
    EXPECT_TRUE(std::ranges::all_of(*path, [](Wgs84 place) { return place.alt_m == 55.5; }));
    double lateral_m = 0.0;
    for (std::size_t i = 1; i + 2 < path->size(); i += 2) {
      double const gap_m = geo::surface_distance_m((*path)[i], (*path)[i + 1]);
      EXPECT_LE(gap_m, area.spacing_m * 1.001);
      lateral_m += gap_m;
    }
    EXPECT_NEAR(lateral_m, area.width_m, area.width_m * 2e-3);  // meridians draw together towards the pole
    EXPECT_NEAR(geo::surface_distance_m((*path)[2], (*path)[3]), area.length_m + 50.0, area.length_m * 2e-3);
  }
}

TEST(Survey, RefusesWhatIsNoArea) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  for (auto const& [length_m, width_m, spacing_m] :
       {std::tuple{0.0, 1.0, 1.0}, std::tuple{1.0, -1.0, 1.0}, std::tuple{1.0, 1.0, 0.0}, std::tuple{nan, 1.0, 1.0},
        std::tuple{1.0, 1e300, 1.0}, std::tuple{1.0, 10.0, 1e-9}, std::tuple{1.0, 1.0, 1.0 / 0.0}}) {
    auto const path = survey_path({.base = {}, .length_m = length_m, .width_m = width_m, .spacing_m = spacing_m});
    ASSERT_FALSE(path) << length_m << " " << width_m << " " << spacing_m;
    EXPECT_EQ(path.error().kind, base::ErrorKind::invalid_input);
  }
}

}  // namespace
}  // namespace lapwing::plan
