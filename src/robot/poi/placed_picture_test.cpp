#include "robot/poi/placed_picture.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;

TEST(PlacedPicture, LooksWhereTheCameraLooks) {
  // A robot that looks north, with a camera on its left side, to the left and upwards.
  CameraMount const mount{.x_m = 0.1, .y_m = 0.2, .up_m = 0.9, .yaw_rad = std::numbers::pi / 2.0, .pitch_rad = 0.3};
  auto const picture = placed_picture(
      mount, {.site = "site", .floor = {}, .position = {5.0, 7.0, 1.0}, .yaw_rad = std::numbers::pi / 2.0});
  EXPECT_NEAR(picture.position.x(), 4.8, 1e-9);
  EXPECT_NEAR(picture.position.y(), 7.1, 1e-9);
  EXPECT_NEAR(picture.up_m, 1.9, 1e-9);
  ASSERT_TRUE(picture.site_from_camera);
  Eigen::Vector3d const ahead = *picture.site_from_camera * Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(-std::cos(0.3), 0.0, std::sin(0.3)), 1e-9)) << "west, and up";
  Eigen::Vector3d const right = *picture.site_from_camera * Eigen::Vector3d::UnitX();
  EXPECT_TRUE(right.isApprox(Eigen::Vector3d(0.0, 1.0, 0.0), 1e-9)) << "north";
  Eigen::Vector3d const down = *picture.site_from_camera * Eigen::Vector3d::UnitY();
  EXPECT_LT(down.z(), 0.0);
}

struct MovedPictures : ::testing::Test {
  void SetUp() override {
    auto const site = geo::Site::make("site", geo::Wgs84::from_degrees(41.0, -8.0, 90.0));
    ASSERT_TRUE(site);
    live_map.put_site(*site);
    for (auto const& id : ids) {
      auto picture = placed_picture(
          {.x_m = 0.0, .yaw_rad = 0.0, .pitch_rad = 0.0},
          {.site = "site", .floor = {}, .position = {id == "far" ? 9.0 : 1.0, 2.0, 0.0}, .yaw_rad = 0.5});
      picture.image = std::string(64, 'a');
      picture.width_px = 960;
      picture.height_px = 720;
      picture.vehicle = "robot1";
      picture.taken_at = at(1s);
      auto const put = live_map.put(
          {.id = id, .site = "site", .account = {.writer = "robot1", .at = at(1s)}, .content = std::move(picture)});
      ASSERT_TRUE(put) << put.error().message;
    }
  }
  static base::UtcTime at(base::Duration after) { return base::UtcTime(std::chrono::hours(24 * 365 * 30)) + after; }
  map::FeatureRecord const& record(std::string const& id) { return *live_map.find(map::LayerKind::pictures, id); }
  map::Picture picture(std::string const& id) { return std::get<map::Picture>(record(id).feature.content); }
  void move() {
    move_pictures(live_map, ids,
                  [](geo::Pose<geo::SiteFrame> const& before) -> geo::Pose<geo::SiteFrame> {
                    if (before.position.x() < 5.0) return before;
                    return {{before.position.x() - 0.5, before.position.y() + 0.1}, before.yaw_rad + 0.2};
                  },
                  {.writer = "robot1", .at = at(2s)});
  }

  map::LiveMap live_map{[] { return at(1min); }};
  std::vector<std::string> ids{"near", "far"};
};

TEST_F(MovedPictures, GoWithWhatHasMovedOfTheMapAndTurnWithIt) {
  auto const before = record("near").revision;
  move();
  auto const far = picture("far");
  EXPECT_NEAR(far.position.x(), 8.5, 1e-9);
  EXPECT_NEAR(far.position.y(), 2.1, 1e-9);
  Eigen::Vector3d const ahead = *far.site_from_camera * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), 0.7, 1e-9);
  EXPECT_EQ(far.taken_at, at(1s)) << "it is not another picture";
  EXPECT_EQ(record("near").revision, before) << "nobody is told of what stays";
}

TEST_F(MovedPictures, ComeNotBackWhenSomebodyHasRemovedThem) {
  ASSERT_TRUE(live_map.remove(map::LayerKind::pictures, "far", {.writer = "operator", .at = at(3s)}));
  move();
  EXPECT_TRUE(record("far").is_removed);
  EXPECT_EQ(ids, std::vector<std::string>{"near"});
}

}  // namespace
}  // namespace lapwing::robot
