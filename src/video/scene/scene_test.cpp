#include "video/scene/scene.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "video/testing/small_car_park.hpp"

namespace lapwing::video {
namespace {

Occupation nothing_on(CarPark const& park) {
  return {.taken = std::vector<bool>(park.slots.size(), false), .vehicles = {}};
}

cv::Mat seen(Scene const& scene, geo::GroundView const& view, Occupation const& now) {
  return scene.seen(view, rays_of(view.lens), now);
}

/// How bright the picture is round a pixel.
double light_at(cv::Mat const& picture, geo::Pixel const& pixel, int reach = 1) {
  cv::Rect const around(static_cast<int>(pixel.x) - reach, static_cast<int>(pixel.y) - reach, 2 * reach + 1,
                        2 * reach + 1);
  auto const mean = cv::mean(picture(around & cv::Rect({}, picture.size())));
  return (mean[0] + mean[1] + mean[2]) / 3.0;
}

/// New asphalt, white crosses of 2 m on it, no shadows: only geometry is tried.
CarPark crosses(std::vector<Spot> const& at) {
  CarPark park{.light = {.shadow = 0.0}, .pixel_m = 0.02, .wear = 0.0};
  park.patches.push_back({.corners = {Spot(-30, -30), Spot(30, -30), Spot(30, 30), Spot(-30, 30)}});
  for (auto const& spot : at) {
    park.stripes.push_back(
        {.points = {spot - geo::Vector<geo::SiteFrame>(1, 0), spot + geo::Vector<geo::SiteFrame>(1, 0)}});
    park.stripes.push_back(
        {.points = {spot - geo::Vector<geo::SiteFrame>(0, 1), spot + geo::Vector<geo::SiteFrame>(0, 1)}});
  }
  return park;
}

/// The middle of the brightest round a pixel, weighted by how much brighter it is than asphalt.
cv::Point2d middle_of_paint(cv::Mat const& picture, geo::Pixel const& near, int reach) {
  cv::Rect const around(static_cast<int>(near.x) - reach, static_cast<int>(near.y) - reach, 2 * reach + 1,
                        2 * reach + 1);
  auto const box = around & cv::Rect({}, picture.size());
  cv::Mat grey;
  cv::cvtColor(picture(box), grey, cv::COLOR_BGR2GRAY);
  cv::threshold(grey, grey, 170.0, 255.0, cv::THRESH_BINARY);
  auto const moments = cv::moments(grey, true);
  return cv::Point2d(box.x + moments.m10 / moments.m00 + 0.5, box.y + moments.m01 / moments.m00 + 0.5);
}

TEST(Scene, PaintIsDrawnWhereTheCameraModelSays) {
  std::vector<Spot> const at = {Spot(0, 0), Spot(4, 3), Spot(-5, 2), Spot(3, -3), Spot(-4, -3)};
  Scene const scene(crosses(at), {});
  auto bent = geo::pinhole(960, 720, 1.1);
  bent.k1 = -0.12;
  bent.k2 = 0.02;
  bent.p1 = 0.001;
  for (auto const& lens : {geo::pinhole(960, 720, 1.1), bent})
    for (double const tilt : {0.0, 0.35})
      for (double const yaw : {0.3, 2.0}) {
        geo::GroundView const view{
            .lens = lens,
            .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(0.4, -0.7, 12.0), yaw, tilt, 0.05)};
        auto const picture = seen(scene, view, nothing_on(scene.park()));
        int tried = 0;
        for (auto const& spot : at) {
          auto const pixel = geo::seen_at(view, spot);
          constexpr double border_px = 40.0;
          if (!pixel || pixel->x < border_px || pixel->y < border_px || pixel->x > lens.width_px - border_px ||
              pixel->y > lens.height_px - border_px)
            continue;
          auto const found = middle_of_paint(picture, *pixel, 20);
          EXPECT_NEAR(found.x, pixel->x, 0.7) << "tilt " << tilt << " yaw " << yaw;
          EXPECT_NEAR(found.y, pixel->y, 0.7) << "tilt " << tilt << " yaw " << yaw;
          ++tried;
        }
        EXPECT_GE(tried, 3);
      }
}

TEST(Scene, ACornerOfASlotIsWhereItsLinesEnd) {
  CarPark park = crosses({});
  add_row(park, {.name = "A", .at = Spot(-2.5, -2.5), .count = 2, .line_m = 0.12});
  Scene const scene(park, {});
  geo::GroundView const view{.lens = geo::pinhole(960, 720, 1.0),
                             .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(0, 0, 9.0), 0.4, 0.0)};
  auto const picture = seen(scene, view, nothing_on(park));
  for (auto const& slot : park.slots) {
    auto const mouth = slot.outline[0];
    auto const way = (slot.outline[3] - mouth) * (1.0 / (slot.outline[3] - mouth).length());
    EXPECT_GT(light_at(picture, geo::seen_at(view, mouth + way * 0.1).value()), 180.0);
    EXPECT_LT(light_at(picture, geo::seen_at(view, mouth - way * 0.1).value()), 150.0);
  }
}

TEST(Scene, ACarHidesWhatLiesBehindItAndLeansAway) {
  CarPark park = crosses({Spot(0, 6)});
  park.cars.push_back(
      {.at = Spot(0, 4), .look = {.length_m = 4.4, .width_m = 1.8, .height_m = 1.8, .paint = {0.1, 0.1, 0.1}}});
  Scene const scene(park, {});
  geo::GroundView const low{
      .lens = geo::pinhole(960, 720, 1.1),
      .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(0, -4, 5.0), std::numbers::pi / 2, 0.9)};
  auto const with_car = seen(scene, low, occupation_at(park, {}));
  auto const without = seen(scene, low, nothing_on(park));
  // The ground beyond the car, 1.2 m from its middle: in line with its roof.
  auto const beyond = geo::seen_at(low, Spot(0, 5.2)).value();
  EXPECT_GT(light_at(without, beyond) - light_at(with_car, beyond), 40.0);
  // From straight above nothing of that is hidden.
  geo::GroundView const above{.lens = geo::pinhole(960, 720, 1.1),
                              .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(0, 4, 12.0), 0.0, 0.0)};
  auto const pixel = geo::seen_at(above, Spot(0, 5.3)).value();
  EXPECT_NEAR(light_at(seen(scene, above, occupation_at(park, {})), pixel),
              light_at(seen(scene, above, nothing_on(park)), pixel), 12.0);
}

TEST(Scene, ShadowsFallAwayFromTheSun) {
  CarPark park = crosses({});
  park.light = {.sun_azimuth_rad = std::numbers::pi / 2.0, .sun_height_rad = 0.6, .shadow = 0.7};  // in the east
  park.cars.push_back({.at = Spot(0, 0), .heading_rad = std::numbers::pi / 2.0});
  Scene const scene(park, {});
  geo::GroundView const view{.lens = geo::pinhole(960, 720, 1.1),
                             .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(0, 0, 12.0), 0.0, 0.0)};
  auto const picture = seen(scene, view, occupation_at(park, {}));
  double const west = light_at(picture, geo::seen_at(view, Spot(-1.6, 0)).value(), 3);
  double const east = light_at(picture, geo::seen_at(view, Spot(1.6, 0)).value(), 3);
  EXPECT_LT(west, 0.7 * east);
}

TEST(Scene, ATreeHidesTheSlotUnderIt) {
  auto park = testing::small_car_park(1, 0.0);
  park.trees.push_back({.at = park.slots[2].middle(), .radius_m = 2.0, .height_m = 5.0});
  Scene const scene(park, {});
  auto const at = park.slots[2].middle();
  geo::GroundView const view{
      .lens = geo::pinhole(640, 480, 1.0),
      .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(at.x(), at.y(), 20.0), 0.0, 0.0)};
  auto const mean = cv::mean(seen(scene, view, nothing_on(park))(cv::Rect(300, 220, 40, 40)));
  EXPECT_GT(mean[1], mean[0] + 15.0);  // green
  EXPECT_GT(mean[1], mean[2]);
}

TEST(Scene, ACameraOnTheGroundOrTowardsTheSkyHasAPictureToo) {
  auto park = testing::small_car_park(1, 1.0);
  park.blocks.push_back({.corners = {Spot(-15, 8), Spot(15, 8), Spot(15, 13), Spot(-15, 13)}});
  park.trees.push_back({.at = Spot(12, 0)});
  Scene const scene(park, {});
  for (double const up_m : {-3.0, 0.0, 0.3, 400.0})
    for (double const tilt : {0.0, 1.2, 1.57, 2.5}) {
      geo::GroundView const view{
          .lens = geo::pinhole(160, 120, 1.0),
          .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(0, 0, up_m), 1.0, tilt)};
      EXPECT_EQ(seen(scene, view, occupation_at(park, {})).size(), cv::Size(160, 120));
    }
}

TEST(Scene, APhotographOfTheGroundLiesWhereItsBoxSays) {
  CarPark park = crosses({});
  park.picture = GroundPicture{"", Spot(-10, -10), Spot(10, 10)};
  cv::Mat photograph(400, 400, CV_8UC3, cv::Scalar(30, 30, 30));
  photograph(cv::Rect(200, 0, 200, 200)).setTo(cv::Scalar(0, 0, 230));  // its north-east
  Scene const scene(park, photograph);
  geo::GroundView const view{.lens = geo::pinhole(640, 480, 1.2),
                             .site_from_camera = geo::camera_at(geo::Point3<geo::SiteFrame>(0, 0, 15.0), 0.0, 0.0)};
  auto const picture = seen(scene, view, nothing_on(park));
  auto const red_at = [&](Spot const& spot) {
    auto const pixel = geo::seen_at(view, spot).value();
    return picture.at<cv::Vec3b>(static_cast<int>(pixel.y), static_cast<int>(pixel.x))[2];
  };
  EXPECT_GT(red_at(Spot(4, 4)), 200);
  EXPECT_LT(red_at(Spot(-4, 4)), 60);
  EXPECT_LT(red_at(Spot(4, -4)), 60);
}

}  // namespace
}  // namespace lapwing::video
