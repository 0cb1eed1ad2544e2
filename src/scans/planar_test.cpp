#include "scans/planar.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::scans {
namespace {

bus::Quaternion turned_by(double yaw_rad) {
  return {.z = std::sin(yaw_rad / 2.0), .w = std::cos(yaw_rad / 2.0)};
}

bus::TransformStamped frame(std::string const& child, std::string const& parent, bus::Transform const& transform) {
  return {.header = {.frame_id = parent}, .child_frame_id = child, .transform = transform};
}

TEST(StaticFrames, AreFollowedFromParentToParent) {
  StaticFrames frames;
  frames.take({.transforms = {frame("laser", "mast", {.translation = {.x = 0.5}}),
                              frame("mast", "base_link",
                                    {.translation = {.x = 1.0}, .rotation = turned_by(std::numbers::pi / 2.0)})}});
  auto const found = frames.find("laser", "base_link");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->pose.x, 1.0, 1e-12);
  EXPECT_NEAR(found->pose.y, 0.5, 1e-12);
  EXPECT_NEAR(found->pose.yaw, std::numbers::pi / 2.0, 1e-12);
  EXPECT_FALSE(found->is_upside_down);
  EXPECT_FALSE(frames.find("camera", "base_link"));
  EXPECT_EQ(frames.find("base_link", "base_link"), PlanarFrame{});
  EXPECT_EQ(frames.root_of("laser"), "base_link");
  EXPECT_EQ(frames.root_of("camera"), "camera");
}

TEST(StaticFrames, ThatGoInACircleLeadNowhere) {
  StaticFrames frames;
  frames.take({.transforms = {frame("a", "b", {}), frame("b", "a", {})}});
  EXPECT_FALSE(frames.find("a", "base_link"));
  EXPECT_FALSE(frames.root_of("a").empty()) << "it comes to an end";
}

TEST(StaticFrames, KnowWhatHangsUpsideDown) {
  // Turned about its x axis by half a turn, and then to the left.
  StaticFrames frames;
  frames.take({.transforms = {frame("laser", "plate", {.translation = {.y = 0.2}, .rotation = turned_by(0.3)}),
                              frame("plate", "base_link", {.rotation = {.x = 1.0, .w = 0.0}})}});
  auto const found = frames.find("laser", "base_link");
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_upside_down);
  EXPECT_NEAR(found->pose.y, -0.2, 1e-12);
  EXPECT_NEAR(found->pose.yaw, -0.3, 1e-12);
}

TEST(StaticFrames, ThatAreNoNumbersAreNotTaken) {
  StaticFrames frames;
  frames.take({.transforms = {frame("laser", "base_link", {.translation = {.x = std::nan("")}})}});
  EXPECT_FALSE(frames.find("laser", "base_link"));
}

}  // namespace
}  // namespace lapwing::scans
