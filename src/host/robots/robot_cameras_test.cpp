#include "host/robots/robot_cameras.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::host {
namespace {

std::vector<RobotCamera> read(std::string const& text) {
  base::SourceFile const source("folder/cameras.toml", text);
  base::Diagnostics diagnostics(source);
  auto cameras = read_robot_cameras(source, diagnostics);
  EXPECT_FALSE(diagnostics.has_errors()) << base::render(diagnostics);
  return cameras;
}

std::string mistakes(std::string const& text) {
  base::SourceFile const source("cameras.toml", text);
  base::Diagnostics diagnostics(source);
  (void)read_robot_cameras(source, diagnostics);
  return base::render(diagnostics);
}

TEST(RobotCameras, SayWhereTheirPicturesComeFromAndHowTheySit) {
  auto const cameras = read(R"(
[[camera]]
source = "/dev/video0"
width = 640
height = 480
view_deg = 60
at = [0.1, 0.05, 0.8]
yaw_deg = 90
pitch_deg = 12

[[camera]]
robot = "robot2"
folder = "pictures"

[[camera]]
robot = "robot2"
topic = "/robot2/image_raw/compressed"
)");
  ASSERT_EQ(cameras.size(), 3U);
  auto const& [robot, kind, from, mount, photographs] = cameras[0];
  EXPECT_EQ(robot, "robot1");
  EXPECT_EQ(kind, RobotCamera::Kind::source);
  EXPECT_EQ(from, "/dev/video0");
  EXPECT_EQ(mount.width_px, 640);
  EXPECT_EQ(mount.height_px, 480);
  EXPECT_NEAR(mount.view_rad, std::numbers::pi / 3.0, 1e-12);
  EXPECT_EQ(mount.x_m, 0.1);
  EXPECT_EQ(mount.y_m, 0.05);
  EXPECT_EQ(mount.up_m, 0.8);
  EXPECT_NEAR(mount.yaw_rad, std::numbers::pi / 2.0, 1e-12);
  EXPECT_NEAR(mount.pitch_rad, 12.0 * std::numbers::pi / 180.0, 1e-12);
  EXPECT_EQ(cameras[1].kind, RobotCamera::Kind::folder);
  EXPECT_EQ(cameras[1].from, "folder/pictures") << "beside the file";
  EXPECT_EQ(cameras[2].kind, RobotCamera::Kind::topic);
}

TEST(RobotCameras, TheOneThatLooksAheadMostPhotographsUnlessAnotherIsNamed) {
  auto const by_place = read(R"(
[[camera]]
source = "left"
yaw_deg = 90
[[camera]]
source = "ahead"
yaw_deg = -10
)");
  EXPECT_FALSE(by_place[0].photographs);
  EXPECT_TRUE(by_place[1].photographs);
  auto const by_name = read(R"(
[[camera]]
source = "left"
yaw_deg = 90
photographs = true
[[camera]]
source = "ahead"
)");
  EXPECT_TRUE(by_name[0].photographs);
  EXPECT_FALSE(by_name[1].photographs);
}

TEST(RobotCameras, AllThatIsWrongIsSaid) {
  auto const none = mistakes("[[camera]]\nyaw_deg = 90\n");
  EXPECT_NE(none.find("nothing says where the camera's pictures come from"), std::string::npos) << none;
  auto const two = mistakes("[[camera]]\nsource = \"/dev/video0\"\ntopic = \"/image\"\n");
  EXPECT_NE(two.find("come from two places"), std::string::npos) << two;
  auto const wrong = mistakes("[[camera]]\nsource = \"concat:a|b://c\"\nview_deg = 400\nyaw = 90\n");
  EXPECT_NE(wrong.find("do not come that way"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("view_deg"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("no setting yaw"), std::string::npos) << wrong;
}

}  // namespace
}  // namespace lapwing::host
