#include "vehicle/place.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "vehicle/aspects/motion.hpp"

namespace lapwing::vehicle {
namespace {

using namespace std::chrono_literals;

geo::Wgs84 const anchor = geo::Wgs84::from_degrees(52.1, 13.4, 40.0);

geo::Site office() {
  return *geo::Site::make("office", anchor);
}

TEST(Place, OfASiteIsFoundOnTheGlobe) {
  SitePose const pose{.site = "office", .position = {30.0, 40.0, 2.0}, .yaw_rad = 0.0};
  auto const found = on_globe(pose, office());
  ASSERT_TRUE(found);
  EXPECT_NEAR(geo::surface_distance_m(found->position, anchor), 50.0, 1e-3);
  EXPECT_NEAR(geo::bearing_rad(anchor, found->position), std::atan2(30.0, 40.0), 1e-5);
  EXPECT_NEAR(found->position.alt_m, 42.0, 1e-3);
  EXPECT_NEAR(*found->heading_rad, std::numbers::pi / 2, 1e-12) << "along the x axis is east";
}

TEST(Place, LooksNorthAlongTheYAxis) {
  SitePose const pose{.site = "office", .position = {}, .yaw_rad = std::numbers::pi / 2};
  EXPECT_NEAR(*on_globe(pose, office())->heading_rad, 0.0, 1e-12);
}

TEST(Place, OfAnotherSiteIsNotFound) {
  SitePose const pose{.site = "barn", .position = {}};
  EXPECT_FALSE(on_globe(pose, office()));
}

TEST(Place, OnTheGlobeStaysAsItIs) {
  GlobePose const pose{.position = anchor, .heading_rad = 1.0};
  EXPECT_EQ(on_globe(pose, office()), pose);
}

TEST(Motion, IsInTheFrameThatWasHeardLast) {
  Motion motion;
  EXPECT_FALSE(motion.place());
  motion.position.set(anchor, base::TimePoint(1s));
  motion.heading_rad.set(0.5, base::TimePoint(1s));
  EXPECT_EQ(motion.place(), Place(GlobePose{.position = anchor, .heading_rad = 0.5}));
  SitePose const indoors{.site = "office", .position = {1.0, 2.0, 0.0}, .yaw_rad = 0.25};
  motion.site_pose.set(indoors, base::TimePoint(2s));
  EXPECT_EQ(motion.place(), Place(indoors)) << "it has driven in";
  motion.position.set(anchor, base::TimePoint(3s));
  EXPECT_EQ(motion.place(), Place(GlobePose{.position = anchor, .heading_rad = 0.5})) << "and out again";
}

}  // namespace
}  // namespace lapwing::vehicle
