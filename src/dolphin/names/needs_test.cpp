#include "dolphin/names/needs.hpp"

#include <gtest/gtest.h>

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/parser.hpp"

namespace lapwing::dolphin {
namespace {

Needs needs(std::string const& script) {
  base::SourceFile const source("test.dolphin", script);
  base::Diagnostics diagnostics(source);
  auto const program = parse(diagnostics);
  EXPECT_EQ(base::render(diagnostics), "");
  return needs_of(program);
}

TEST(Needs, OfEveryPickInTheText) {
  auto const found = needs(
      "a = pick { type 'UAV'; count 2; timeout 30.seconds }\n"
      "while (true) { b = pick { type 'UGV'; payload 'Sonar', 'Camera' } }\n"
      "c = pick {}");
  ASSERT_EQ(found.vehicles.size(), 3U);
  EXPECT_EQ(found.vehicles[0].type, "UAV");
  EXPECT_EQ(found.vehicles[0].count, 2);
  EXPECT_EQ(found.vehicles[1].type, "UGV");
  EXPECT_EQ(found.vehicles[1].payload, (std::vector<std::string>{"Sonar", "Camera"}));
  EXPECT_EQ(found.vehicles[2].type, "");
  EXPECT_EQ(found.vehicles[2].count, 1);
  EXPECT_TRUE(found.unclear.empty());
}

TEST(Needs, FollowsVariablesThatAreAssignedOnce) {
  auto const found = needs("n = 3\nkind = 'UAV'\nv = pick { count n; type kind }");
  ASSERT_EQ(found.vehicles.size(), 1U);
  EXPECT_EQ(found.vehicles[0].count, 3);
  EXPECT_EQ(found.vehicles[0].type, "UAV");
}

TEST(Needs, LeavesUnclearWhatOnlyRunTimeTells) {
  EXPECT_EQ(needs("n = 3\nn = 4\nv = pick { count n }").unclear.size(), 1U);
  EXPECT_EQ(needs("v = pick { count ask('how many?') }").unclear.size(), 1U);
  EXPECT_EQ(needs("v = pick { id 'a1' }").unclear.size(), 1U);
  EXPECT_EQ(needs("v = pick { count 0 }").unclear.size(), 1U);
  EXPECT_EQ(needs("v = pick { count 1e9 }").unclear.size(), 1U);
  EXPECT_EQ(needs("a = b\nb = a\nv = pick { type a }").unclear.size(), 1U);
}

TEST(Needs, TakesTheHomeOfTheFirstMission) {
  auto const found = needs(
      "far = location(1, 2, 3)\n"
      "base = location(41.5, -8.25, 90)\n"
      "m = mission { name 'm'; home base; takeOff far }");
  ASSERT_TRUE(found.home);
  EXPECT_NEAR(found.home->lat_deg(), 41.5, 1e-12);
  EXPECT_NEAR(found.home->lon_deg(), -8.25, 1e-12);
  EXPECT_EQ(found.home->alt_m, 90.0);
}

TEST(Needs, TakesAHomeInNumbersAndUnits) {
  auto const found = needs(
      "m = mission { name 'Orchard'; home 41.2, -8.6, 90.meters; takeOff location(41.2, -8.6, 120); move 30, 0 }");
  ASSERT_TRUE(found.home);
  EXPECT_NEAR(found.home->lat_deg(), 41.2, 1e-12);
  EXPECT_NEAR(found.home->lon_deg(), -8.6, 1e-12);
  EXPECT_EQ(found.home->alt_m, 90.0);
  EXPECT_EQ(needs("ground = 60 + 30\nm = mission { home 41.2, -8.6, ground }").home->alt_m, 90.0);
  EXPECT_EQ(needs("m = mission { home 41.2, -8.6 }").home->alt_m, 0.0);
}

TEST(Needs, LeavesOutAHomeThatIsNoPlace) {
  EXPECT_FALSE(needs("m = mission { home 141.2, -8.6, 90 }").home);
  EXPECT_FALSE(needs("m = mission { home somewhere, -8.6, 90 }").home);
  EXPECT_FALSE(needs("m = mission { home 1, 2, 3, 4 }").home);
}

TEST(Needs, WithoutAHomeTakesTheFirstLocation) {
  EXPECT_NEAR(needs("area = (location 38.5, -8.5) ^ 2.km").home->lat_deg(), 38.5, 1e-12);
  EXPECT_FALSE(needs("message 'hello'").home);
  EXPECT_FALSE(needs("p = location(lat, 3, 4)").home);
  EXPECT_FALSE(needs("p = location(91, 3, 4)").home);
}

}  // namespace
}  // namespace lapwing::dolphin
