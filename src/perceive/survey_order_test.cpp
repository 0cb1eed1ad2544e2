#include "perceive/survey_order.hpp"

#include <gtest/gtest.h>

namespace lapwing::perceive {
namespace {

TEST(SurveyOrder, FindsTheFramesOriginByHome) {
  auto const origin = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);
  auto const home = geo::LocalFrame(origin).place_at({.north = 35.0, .east = -12.0, .down = -3.0});
  auto const found = anchor_of(home, {-12.0, 35.0, 3.0});
  EXPECT_LT(geo::distance_m(found, origin), 0.01);
}

TEST(SurveyOrder, FencesWhatHasNoFence) {
  std::vector<map::SitePoint> const places = {{0.0, 0.0},  {40.0, 0.0},  {40.0, 20.0},
                                              {0.0, 20.0}, {20.0, 10.0}, {-30.0, 5.0}};
  auto const fence = fence_round(places, 10.0);
  EXPECT_FALSE(geo::polygon_fault(fence));
  for (auto const& place : places) EXPECT_TRUE(geo::contains(fence, place));
  EXPECT_TRUE(geo::contains(fence, {49.5, 5.0}));
  EXPECT_FALSE(geo::contains(fence, {50.5, 5.0}));
  EXPECT_TRUE(geo::contains(fence, {-39.0, 5.0})) << "home";
  EXPECT_FALSE(geo::contains(fence, {-30.0, 30.0})) << "it is convex, and no larger than that";
}

}  // namespace
}  // namespace lapwing::perceive
