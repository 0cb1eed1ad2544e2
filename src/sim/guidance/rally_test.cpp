#include "sim/guidance/rally.hpp"

#include <gtest/gtest.h>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

/// A vehicle in the air somewhere, and its rally points.
struct Scene {
  Site site{geo::Wgs84::from_degrees(41.0, -8.0, 0.0)};
  Body body;
  Airframe airframe;
  Pace pace;
  Tuning tuning{.rally_limit_m = 300.0, .rally_includes_home = true};
  MissionPlan rally;

  explicit Scene(geo::Ned here) { body.position_m = here; }
  void add(geo::Ned point) { rally.push_back(ItemMaker{site.anchor()}.at(MavCmd::nav_rally_point, point)); }
  [[nodiscard]] ReturnPlace place() const {
    return return_place({body, airframe, site, pace, tuning, rally, {}, 0s, 0.0});
  }
};

TEST(Rally, TakesTheNearestPointThatIsNearerThanHome) {
  Scene scene({100, 0, -20});
  EXPECT_FALSE(scene.place().is_rally);
  scene.add({60, 0, -15});
  scene.add({120, 0, -25});
  EXPECT_TRUE(scene.place().is_rally);
  EXPECT_NEAR(scene.place().point.north, 120.0, 0.1);
  EXPECT_NEAR(scene.place().point.down, -25.0, 0.1);
  scene.body.position_m = {10, 0, -20};
  EXPECT_FALSE(scene.place().is_rally) << "home is nearer";
  scene.tuning.rally_includes_home = false;
  EXPECT_TRUE(scene.place().is_rally);
}

TEST(Rally, LeavesOutPointsBeyondTheLimit) {
  Scene scene({1000, 0, -20});
  scene.add({600, 0, -15});
  EXPECT_FALSE(scene.place().is_rally);
  scene.tuning.rally_limit_m = 0.0;
  EXPECT_TRUE(scene.place().is_rally);
}

TEST(Rally, IsWhereACopterReturnsTo) {
  TestGround ground("copter");
  ground.hover(15);
  ground.vehicle().plans().rally = {ground.maker().at(MavCmd::nav_rally_point, {60, 0, -10})};
  ground.go_to(80, 0, 15, 20s);
  EXPECT_EQ(ground.set_mode(6), MavResult::accepted);
  EXPECT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 120s));
  EXPECT_NEAR(ground.from_start(), 60.0, 1.0);
  EXPECT_TRUE(ground.pilot().body().on_ground);
}

TEST(Rally, IsWhereARoverReturnsTo) {
  TestGround ground("rover");
  ground.arm_in(rover_guided);
  ground.vehicle().plans().rally = {ground.maker().at(MavCmd::nav_rally_point, {30, 0, 0})};
  ground.go_to(50, 0, 0, 20s);
  EXPECT_EQ(ground.set_mode(11), MavResult::accepted);
  ground.run_for(20s);
  EXPECT_NEAR(ground.from_start(), 30.0, 3.0);
}

}  // namespace
}  // namespace lapwing::sim
