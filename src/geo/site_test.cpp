#include "geo/site.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::geo {
namespace {

Wgs84 const porto = Wgs84::from_degrees(41.178, -8.598, 90.0);

Site office() {
  return *Site::make(
      "office", porto,
      {{.id = "1", .up_m = 3.5}, {.id = "B1", .up_m = -3.0}, {.id = "0", .name = "Ground floor", .up_m = 0.0}});
}

TEST(Site, HasItsAxesEastNorthAndUp) {
  auto const site = office();
  auto const north = site.point_of(displaced(porto, {.north = 100.0}));
  EXPECT_NEAR(north.x(), 0.0, 0.01);
  EXPECT_NEAR(north.y(), 100.0, 0.01);
  auto const east = site.point_of(displaced(porto, {.east = 100.0, .down = -20.0}));
  EXPECT_NEAR(east.x(), 100.0, 0.01);
  EXPECT_NEAR(east.z(), 20.0, 0.01);
  EXPECT_EQ(site.point_of(porto), (Point3<SiteFrame>(0.0, 0.0, 0.0)));
}

TEST(Site, GivesEveryPointBackWithinMicrometres) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> metres(-5000.0, 5000.0);
  for (auto const anchor : {porto, Wgs84::from_degrees(-33.9, 179.999, 5.0), Wgs84::from_degrees(78.2, 15.6, 0.0)}) {
    auto const site = *Site::make("s", anchor);
    for (int i = 0; i < 300; ++i) {
      double const x = metres(random);
      double const y = metres(random);
      Point3<SiteFrame> const point(x, y, metres(random) / 50.0);
      EXPECT_LT(distance_m(site.point_of(site.place_of(point)), point), 1e-6);
    }
  }
}

TEST(Site, KnowsItsFloorsByIdAndHeight) {
  auto const site = office();
  ASSERT_EQ(site.floors().size(), 3u);
  EXPECT_EQ(site.floors().front().id, "B1");
  EXPECT_EQ(site.floor("0")->name, "Ground floor");
  EXPECT_EQ(site.floor("7"), nullptr);
  EXPECT_EQ(site.floor_at(-9.0).id, "B1");
  EXPECT_EQ(site.floor_at(-0.2).id, "0") << "a barometer drifts";
  EXPECT_EQ(site.floor_at(2.8).id, "0");
  EXPECT_EQ(site.floor_at(3.4).id, "1");
  EXPECT_EQ(site.floor_at(50.0).id, "1");
  EXPECT_EQ(Site::make("lot", porto)->floors().front().id, "0");
}

TEST(Site, LaysAFloorsPlanWhereItBelongs) {
  Floor const turned{.id = "2", .up_m = 7.0, .site_from_floor = {Point<SiteFrame>(10.0, 20.0), std::numbers::pi / 2.0}};
  auto const site = *Site::make("office", porto, {turned});
  auto const point = site.point_of(site.place_of(Point<FloorFrame>(5.0, 0.0), *site.floor("2")));
  EXPECT_LT(distance_m(point, Point3<SiteFrame>(10.0, 25.0, 7.0)), 1e-6);
}

struct Wrong {
  std::vector<Floor> floors;
  std::string message;
};

TEST(Site, SaysWhatIsWrongWithIt) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  Wrong const cases[] = {
      {{{.id = ""}}, "site s: a floor has no id"},
      {{{.id = "0"}, {.id = "0", .up_m = 3.0}}, "site s: two floors are called 0"},
      {{{.id = "0"}, {.id = "1"}}, "site s: the floors 0 and 1 lie at one height, 0.00 m"},
      {{{.id = "0", .up_m = nan}}, "site s: floor 0: a number is not finite"},
      {{{.id = "0", .site_from_floor = {Point<SiteFrame>(nan, 0.0), 0.0}}}, "site s: floor 0: a number is not finite"},
  };
  for (auto const& one : cases) {
    auto const site = Site::make("s", porto, one.floors);
    ASSERT_FALSE(site) << one.message;
    EXPECT_EQ(site.error().message, one.message);
  }
  EXPECT_EQ(Site::make("s", Wgs84::from_degrees(91.0, 0.0)).error().message,
            "site s: the anchor 91.00000, 0.00000 is no place on Earth");
  EXPECT_FALSE(Site::make("s", Wgs84{.lat_rad = nan}));
}

}  // namespace
}  // namespace lapwing::geo
