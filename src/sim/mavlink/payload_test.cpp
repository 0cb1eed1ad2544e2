#include <gtest/gtest.h>

#include <numbers>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

constexpr double degree = std::numbers::pi / 180.0;

void set_parameter(TestGround& ground, std::string name, float value) {
  ground.send(ParamSet{.target = {}, .name = std::move(name), .value = value});
  ground.run_for(100ms);
}

GimbalDeviceAttitudeStatus gimbal(TestGround& ground) {
  EXPECT_EQ(ground.command(MavCmd::request_message, {285}), MavResult::accepted);
  return ground.last<GimbalDeviceAttitudeStatus>().value();
}

double pitch_of(GimbalDeviceAttitudeStatus const& status) {
  auto const q = status.orientation.value();
  return std::asin(std::clamp(2.0 * (static_cast<double>(q[0] * q[2]) - static_cast<double>(q[3] * q[1])), -1.0, 1.0));
}

TEST(SimulatedCamera, TellsWhereEachPictureWasTaken) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_EQ(ground.command(MavCmd::do_digicam_control, {0, 0, 0, 0, 1}), MavResult::accepted);
  ground.run_for(200ms);
  ASSERT_EQ(ground.all<CameraFeedback>().size(), 1u);
  auto const feedback = *ground.last<CameraFeedback>();
  EXPECT_EQ(feedback.image, 1);
  EXPECT_NEAR(geo::distance_m(feedback.position.value(), ground.vehicle().place()), 0.0, 0.1);
}

TEST(SimulatedCamera, TakesPicturesAtIntervalsUntilItIsTold) {
  TestGround ground("copter");
  ground.boot();
  ground.command(MavCmd::image_start_capture, {0, 1, 3});
  ground.run_for(10s);
  EXPECT_EQ(ground.all<CameraFeedback>().size(), 3u);
  ground.command(MavCmd::image_start_capture, {0, 0.5F, 0});
  ground.run_for(5s);
  ground.command(MavCmd::image_stop_capture);
  auto const taken = ground.all<CameraFeedback>().size();
  EXPECT_NEAR(static_cast<double>(taken), 13.0, 1.0);
  ground.run_for(5s);
  EXPECT_EQ(ground.all<CameraFeedback>().size(), taken);
}

TEST(SimulatedCamera, IsTriggeredByDistanceInAMission) {
  TestGround ground("copter");
  auto const make = ground.maker();
  ground.fly({make.waypoint(0, 0, 0), make.take_off(20), ItemMaker::plain(MavCmd::do_set_cam_trigg_dist, {20, 0, 1, 0}),
              make.waypoint(200, 0, 20), ItemMaker::plain(MavCmd::do_set_cam_trigg_dist),
              make.at(MavCmd::nav_land, {220, 0, 0})});
  ASSERT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 300s));
  auto const pictures = ground.all<CameraFeedback>();
  EXPECT_NEAR(static_cast<double>(pictures.size()), 10.0, 1.5);
  for (std::size_t i = 1; i < pictures.size(); ++i)
    EXPECT_NEAR(geo::surface_distance_m(pictures[i - 1].position.value(), pictures[i].position.value()), 20.0, 1.0);
  EXPECT_NEAR(pictures.back().relative_alt_m.value(), 20.0, 1.0);
}

TEST(SimulatedCamera, RepeatsAPictureThatIsAskedFor) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_EQ(ground.command(MavCmd::request_message, {259}), MavResult::accepted);
  EXPECT_EQ(ground.last<CameraInformation>()->model, "") << "ArduPilot does not know what it triggers";
  EXPECT_EQ(ground.command(MavCmd::request_message, {263, 0}), MavResult::failed);
  set_parameter(ground, "CAM1_TYPE", 6);
  EXPECT_EQ(ground.command(MavCmd::request_message, {259}), MavResult::accepted);
  EXPECT_EQ(ground.last<CameraInformation>()->model, "simulated camera");
  ground.command(MavCmd::image_start_capture, {0, 1, 3});
  ground.run_for(5s);
  EXPECT_EQ(ground.all<CameraImageCaptured>().size(), 3u);
  EXPECT_TRUE(ground.all<CameraFeedback>().empty());
  EXPECT_EQ(ground.command(MavCmd::request_message, {263, 1}), MavResult::accepted);
  EXPECT_EQ(ground.last<CameraImageCaptured>()->image, 1);
  EXPECT_EQ(ground.command(MavCmd::request_camera_image_capture, {2}), MavResult::accepted);
  EXPECT_EQ(ground.last<CameraImageCaptured>()->image, 2);
  EXPECT_EQ(ground.command(MavCmd::request_message, {263, 9}), MavResult::failed);
}

TEST(SimulatedCamera, IsNotThereWhenTheParameterSaysSo) {
  TestGround ground("copter");
  ground.boot();
  set_parameter(ground, "CAM1_TYPE", 0);
  EXPECT_EQ(ground.command(MavCmd::do_digicam_control), MavResult::unsupported);
}

TEST(SimulatedGimbal, TurnsToTheAnglesAtItsPace) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_EQ(ground.command(MavCmd::do_mount_control, {-45, 0, 0, 0, 0, 0, 2}), MavResult::accepted);
  EXPECT_GT(pitch_of(gimbal(ground)), -10.0 * degree);
  ground.run_for(2s);
  EXPECT_NEAR(pitch_of(gimbal(ground)), -45.0 * degree, 1e-3);
  EXPECT_EQ(ground.command(MavCmd::do_gimbal_manager_pitchyaw, {-200, 90, 0, 0, 16}), MavResult::accepted);
  ground.run_for(3s);
  auto const status = gimbal(ground);
  EXPECT_NEAR(pitch_of(status), -90.0 * degree, 1e-3);  // no further than it can
  EXPECT_NE(status.flags & gimbal_flag::yaw_in_earth_frame, 0);
  EXPECT_NEAR(ground.vehicle().gimbal().yaw_rad(), 90.0 * degree, 1e-3);
  EXPECT_EQ(ground.command(MavCmd::do_mount_control, {0, 0, 0, 0, 0, 0, 4}), MavResult::denied);
}

TEST(SimulatedGimbal, KeepsAPlaceInSight) {
  TestGround ground("copter");
  ground.boot();
  auto const place = geo::displaced(ground.vehicle().place(), {.north = 0, .east = 30, .down = 0});
  CommandInt roi{.target = {}, .frame = MavFrame::global_relative_alt, .command = MavCmd::do_set_roi_location};
  roi.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .z_m = 0};
  ground.send(roi);
  ground.set_mode(copter_guided);
  ground.arm();
  ground.command(MavCmd::nav_takeoff, {0, 0, 0, 0, 0, 0, 30});
  ground.run_for(40s);
  EXPECT_NEAR(pitch_of(gimbal(ground)), -45.0 * degree, 3.0 * degree);
  EXPECT_NEAR(ground.vehicle().gimbal().yaw_rad(), 90.0 * degree, 3.0 * degree);
  EXPECT_EQ(ground.command(MavCmd::do_set_roi_none), MavResult::accepted);
  ground.run_for(3s);
  EXPECT_NEAR(pitch_of(gimbal(ground)), 0.0, 1e-3);
}

TEST(SimulatedReceiver, ReportsSticksThatNobodyTouches) {
  TestGround ground("copter");
  ground.boot();
  ground.request(MessageId::rc_channels, 2.0);
  ground.run_for(2s);
  ASSERT_TRUE(ground.last<RcChannels>());
  EXPECT_EQ(ground.last<RcChannels>()->count, 16);
  EXPECT_EQ(ground.last<RcChannels>()->pulses_us[2], 1000);
}

}  // namespace
}  // namespace lapwing::sim
