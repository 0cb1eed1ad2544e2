#include "video/camera/camera.hpp"

#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "base/testing/temporary_folder.hpp"
#include "video/camera/camera_settings.hpp"
#include "video/camera/pose_table.hpp"
#include "video/camera/simulated_camera.hpp"
#include "video/testing/small_car_park.hpp"

namespace lapwing::video {
namespace {

using base::testing::TemporaryFolder;
using std::chrono::milliseconds;

base::UtcTime const begin = base::UtcTime(std::chrono::days(20'000));

CameraSettings small() {
  return {.lens = geo::pinhole(320, 240, 1.1)};
}

Moment over(double x, double y, base::UtcTime at, double yaw_rad = 0.3) {
  return {geo::camera_at(geo::Point3<geo::SiteFrame>(x, y, 15.0), yaw_rad, 0.0), at};
}

cv::Mat taken(Camera& camera, Moment const& moment) {
  auto frame = camera.take(moment);
  EXPECT_TRUE(frame);
  return frame ? frame->picture : cv::Mat();
}

double apart(cv::Mat const& a, cv::Mat const& b) {
  return cv::norm(a, b, cv::NORM_L1) / static_cast<double>(a.total() * 3);
}

TEST(CameraOn, LooksDownFromWhereItSitsOnTheDrone) {
  // The drone looks north and has its nose up; the camera is 0.2 m ahead of its middle.
  Eigen::Quaterniond const turned = Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY());
  BodyPlace const drone(geo::Point3<geo::SiteFrame>(5, 6, 10), turned);
  auto const level = camera_on(drone, {.at = {0.2, 0.0, 0.0}});
  auto const down = level * geo::Vector3<geo::CameraFrame>(0, 0, 1);
  EXPECT_NEAR(down.z(), -1.0, 1e-9);
  auto const upper_edge = level * geo::Vector3<geo::CameraFrame>(0, -1, 0);
  EXPECT_NEAR(upper_edge.y(), 1.0, 1e-9);
  EXPECT_NEAR(level.origin().y(), 6.2, 0.01);
  auto const fixed = camera_on(drone, {.has_gimbal = false}) * geo::Vector3<geo::CameraFrame>(0, 0, 1);
  EXPECT_NEAR(fixed.y(), std::sin(0.2), 1e-9);  // a nose up looks ahead
  auto const tilted = camera_on(drone, {.tilt_rad = 0.5}) * geo::Vector3<geo::CameraFrame>(0, 0, 1);
  EXPECT_NEAR(tilted.y(), std::sin(0.5), 1e-9);
}

TEST(SimulatedCamera, TheSameSeedsGiveTheSamePicturesAndOthersOthers) {
  auto settings = small();
  SimulatedCamera one(settings, testing::small_car_park(), {});
  SimulatedCamera again(settings, testing::small_car_park(), {});
  settings.seed = 2;
  SimulatedCamera other_noise(settings, testing::small_car_park(), {});
  SimulatedCamera other_park(small(), testing::small_car_park(2), {});
  auto const moment = over(0, 0, begin);
  auto const picture = taken(one, moment);
  EXPECT_EQ(cv::norm(picture, taken(again, moment), cv::NORM_INF), 0.0);
  EXPECT_GT(apart(picture, taken(other_noise, moment)), 1.0);
  EXPECT_GT(apart(picture, taken(other_park, moment)), 4.0);
  EXPECT_GT(apart(picture, taken(one, over(0, 0, begin + milliseconds(40)))), 1.0);  // noise is each picture's own
}

TEST(SimulatedCamera, APictureThatComesLateShowsWhatWasSeenThen) {
  auto settings = small();
  settings.faults = {.noise = 0.0, .blur_px = 0.0, .delay = milliseconds(100)};
  SimulatedCamera late(settings, testing::small_car_park(), {});
  settings.faults.delay = {};
  SimulatedCamera prompt(settings, testing::small_car_park(), {});
  static_cast<void>(taken(late, over(0, 0, begin)));
  auto const frame = late.take(over(2, 0, begin + milliseconds(200)));
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->taken, begin + milliseconds(100));
  EXPECT_LT(apart(frame->picture, taken(prompt, over(1, 0, begin + milliseconds(100)))), 0.05);
  EXPECT_GT(apart(frame->picture, taken(prompt, over(2, 0, begin + milliseconds(200)))), 2.0);
}

TEST(SimulatedCamera, SomePicturesDoNotComeWithinTheirTime) {
  auto settings = small();
  settings.faults.missing_share = 0.3;
  SimulatedCamera camera(settings, testing::small_car_park(), {});
  int missing = 0;
  constexpr int asked = 200;
  for (int i = 0; i < asked; ++i) {
    auto const frame = camera.take(over(0, 0, begin + milliseconds(40 * i)));
    if (frame) continue;
    EXPECT_EQ(frame.error().kind, base::ErrorKind::timed_out);
    ++missing;
  }
  EXPECT_GT(missing, 35);
  EXPECT_LT(missing, 85);
}

TEST(SimulatedCamera, ThePoseThatIsToldMayBeWrong) {
  auto settings = small();
  settings.faults = {.noise = 0.0, .blur_px = 0.0, .position_m = 0.5, .angle_rad = 0.01};
  SimulatedCamera off(settings, testing::small_car_park(), {});
  settings.faults = {.noise = 0.0, .blur_px = 0.0};
  SimulatedCamera right(settings, testing::small_car_park(), {});
  EXPECT_GT(apart(taken(off, over(0, 0, begin)), taken(right, over(0, 0, begin))), 2.0);
}

TEST(SimulatedCamera, PosesOfAnotherFrameAreMovedIntoTheWorlds) {
  auto settings = small();
  settings.faults = {.noise = 0.0, .blur_px = 0.0};
  SimulatedCamera own(settings, testing::small_car_park(), {});
  auto const park = testing::small_car_park();
  settings.anchor = geo::LocalFrame(park.anchor).place_at({.north = 3.0, .east = 2.0, .down = 0.0});
  SimulatedCamera moved(settings, park, {});
  EXPECT_LT(apart(taken(moved, over(-2, -3, begin)), taken(own, over(0, 0, begin))), 0.2);
}

TEST(PatternCamera, ShowsTheTime) {
  auto settings = small();
  settings.kind = CameraSettings::Kind::pattern;
  auto const camera = open_camera(settings);
  ASSERT_TRUE(camera);
  auto const first = taken(**camera, over(0, 0, begin));
  EXPECT_EQ(first.size(), cv::Size(320, 240));
  EXPECT_EQ(cv::norm(first, taken(**camera, over(9, 9, begin)), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(first, taken(**camera, over(0, 0, begin + milliseconds(250))), cv::NORM_INF), 100.0);
}

struct FolderOfPictures : ::testing::Test {
  void table(std::string const& lines) { std::ofstream(folder.path() / "poses.csv") << pose_columns << '\n' << lines; }
  void picture(std::string const& name, int width, int tone) {
    cv::imwrite((folder.path() / name).string(), cv::Mat(240, width, CV_8UC3, cv::Scalar::all(tone)));
  }
  [[nodiscard]] base::Result<std::unique_ptr<Camera>> open() const {
    auto settings = small();
    settings.kind = CameraSettings::Kind::folder;
    settings.folder = folder.path();
    return open_camera(settings);
  }
  TemporaryFolder folder;
};

TEST_F(FolderOfPictures, ComesInOrderWithItsPosesAndThenEnds) {
  picture("b.png", 320, 10);
  picture("a.png", 320, 20);
  table("b.png,2026-11-21T10:00:00Z,1,2,30,90,0,0\r\na.png,2026-11-21T10:00:01Z,,,,,,\n");
  auto const camera = open();
  ASSERT_TRUE(camera) << camera.error().message;
  auto const first = (*camera)->take({});
  ASSERT_TRUE(first) << first.error().message;
  EXPECT_EQ(first->picture.at<cv::Vec3b>(5, 5)[0], 10);
  ASSERT_TRUE(first->site_from_camera);
  EXPECT_DOUBLE_EQ(first->site_from_camera->origin().z(), 30.0);
  EXPECT_NEAR((*first->site_from_camera * geo::Vector3<geo::CameraFrame>(0, -1, 0)).y(), 1.0, 1e-9);
  auto const second = (*camera)->take({});
  ASSERT_TRUE(second);
  EXPECT_FALSE(second->site_from_camera);
  EXPECT_EQ(second->taken - first->taken, std::chrono::seconds(1));
  auto const after = (*camera)->take({});
  ASSERT_FALSE(after);
  EXPECT_EQ(after.error().kind, base::ErrorKind::lost);
  EXPECT_NE(after.error().message.find("come to their end after 2"), std::string::npos);
}

TEST_F(FolderOfPictures, OneThatCannotBeReadCostsNothingButItself) {
  picture("small.png", 100, 10);
  picture("good.png", 320, 20);
  std::ofstream(folder.path() / "broken.png") << "no picture";
  table(
      "small.png,2026-11-21T10:00:00Z,,,,,,\nbroken.png,2026-11-21T10:00:00Z,,,,,,\n"
      "gone.png,2026-11-21T10:00:00Z,,,,,,\ngood.png,2026-11-21T10:00:00Z,,,,,,\n");
  auto const camera = open();
  ASSERT_TRUE(camera);
  for (std::string const& word : {std::string("100 by 240"), std::string("broken.png"), std::string("gone.png")}) {
    auto const frame = (*camera)->take({});
    ASSERT_FALSE(frame) << word;
    EXPECT_EQ(frame.error().kind, base::ErrorKind::io);
    EXPECT_NE(frame.error().message.find(word), std::string::npos) << frame.error().message;
  }
  EXPECT_TRUE((*camera)->take({}));
}

TEST_F(FolderOfPictures, WithoutATableThereIsNoCamera) {
  auto const camera = open();
  ASSERT_FALSE(camera);
  EXPECT_EQ(camera.error().kind, base::ErrorKind::not_found);
  EXPECT_NE(camera.error().message.find("poses.csv"), std::string::npos);
}

TEST(PoseTable, WhatIsWrongIsToldWithItsLine) {
  std::string const columns = std::string(pose_columns) + "\n";
  std::vector<std::pair<std::string, std::string>> const wrong = {
      {"", "empty"},
      {"file,time\n", "columns"},
      {columns + "a.png,2026-11-21T10:00:00Z,1,2,3\n", "line 2"},
      {columns + "../a.png,2026-11-21T10:00:00Z,,,,,,\n", "no file in the folder"},
      {columns + "a.png,yesterday,,,,,,\n", "time"},
      {columns + "a.png,2026-11-21T10:00:00Z,1,2,nan,0,0,0\n", "pose"},
      {columns + "a.png,2026-11-21T10:00:00Z,1,2,,0,0,0\n", "pose"},
      {columns + "a.png,2026-11-21T10:00:00Z,1,2,1e9,0,0,0\n", "pose"},
  };
  for (auto const& [text, word] : wrong) {
    auto const pictures = pictures_of_table(text);
    ASSERT_FALSE(pictures) << text;
    EXPECT_NE(pictures.error().message.find(word), std::string::npos) << pictures.error().message;
  }
}

TEST(OpenCamera, SettingsThatNoCameraHasAreRefused) {
  auto settings = small();
  settings.kind = CameraSettings::Kind::pattern;
  settings.lens.focal_x_px = 0.0;
  EXPECT_NE(open_camera(settings).error().message.find("focal length"), std::string::npos);
  settings = small();
  settings.kind = CameraSettings::Kind::pattern;
  settings.lens.width_px = 90'000;
  EXPECT_NE(open_camera(settings).error().message.find("pixels a side"), std::string::npos);
  settings = small();
  settings.world = "/nowhere/world.toml";
  EXPECT_EQ(open_camera(settings).error().kind, base::ErrorKind::not_found);
}

/// What `read_camera` makes of a text.
struct ReadSettings {
  CameraSettings settings;
  std::string mistakes;
};
ReadSettings read(std::string text) {
  base::SourceFile const source("drone.toml", std::move(text));
  base::Diagnostics diagnostics(source);
  auto const table = base::parse_config(source, diagnostics);
  base::ConfigReader reader(table, diagnostics);
  auto settings = read_camera(reader, "/etc/drone");
  return {settings, base::render(diagnostics)};
}

TEST(CameraSettings, AreReadInDegreesAndPixelsAsPeopleHaveThem) {
  auto const [settings, mistakes] = read(R"(
kind = "simulated"
world = "yard.toml"
width = 640
height = 480
focal_px = [500, 501]
middle_px = [319.5, 239.5]
distortion = [-0.1, 0.01, 0.001, 0.002, 0.0]
seed = 9
mount = {at = [0.1, 0, -0.05], tilt_deg = 30, yaw_deg = 90, gimbal = false}
faults = {noise = 3, blur_px = 1, position_m = 0.3, angle_deg = 0.5, delay_s = 0.25, missing_share = 0.01}
)");
  EXPECT_EQ(mistakes, "");
  EXPECT_EQ(settings.world, "/etc/drone/yard.toml");
  EXPECT_EQ(settings.lens.width_px, 640);
  EXPECT_DOUBLE_EQ(settings.lens.focal_y_px, 501.0);
  EXPECT_EQ(settings.lens.middle, (geo::Pixel{320.0, 240.0}));
  EXPECT_DOUBLE_EQ(settings.lens.p1, 0.001);
  EXPECT_NEAR(settings.mount.tilt_rad, std::numbers::pi / 6, 1e-12);
  EXPECT_FALSE(settings.mount.has_gimbal);
  EXPECT_EQ(settings.faults.delay, milliseconds(250));
  EXPECT_EQ(settings.seed, 9U);
}

TEST(CameraSettings, AVideoIsAnAddressADeviceOrAFileBesideTheSettings) {
  auto const source = [](std::string const& text) { return read("kind = \"video\"\nsource = \"" + text + "\"\n"); };
  EXPECT_EQ(source("rtsp://10.0.0.2:554/main").settings.source, "rtsp://10.0.0.2:554/main");
  EXPECT_EQ(source("/dev/video0").settings.source, "/dev/video0");
  EXPECT_EQ(source("flight.mp4").settings.source, "/etc/drone/flight.mp4");
  EXPECT_EQ(source("rtsp://10.0.0.2:554/main").mistakes, "");
  EXPECT_NE(source("concat://a|b").mistakes.find("rtsp://, rtsps://"), std::string::npos);
}

TEST(CameraSettings, WhatIsMissingOrUnknownIsTold) {
  EXPECT_NE(read("kind = \"simulated\"\n").mistakes.find("needs world"), std::string::npos);
  EXPECT_NE(read("kind = \"folder\"\n").mistakes.find("needs folder"), std::string::npos);
  EXPECT_NE(read("kind = \"video\"\n").mistakes.find("needs source"), std::string::npos);
  EXPECT_NE(read("kind = \"webcam\"\nworld = \"w\"\n").mistakes.find("simulated, video, folder, pattern"),
            std::string::npos);
  EXPECT_NE(read("kind = \"pattern\"\nwidht = 3\n").mistakes.find("did you mean width"), std::string::npos);
  EXPECT_NE(read("kind = \"pattern\"\ndistortion = [-5, 0, 0, 0, 0]\n").mistakes.find("no sound lens"),
            std::string::npos);
}

}  // namespace
}  // namespace lapwing::video
