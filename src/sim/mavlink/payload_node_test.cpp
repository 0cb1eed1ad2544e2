#include "sim/mavlink/payload_node.hpp"

#include <gtest/gtest.h>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

constexpr std::uint8_t camera = 100;
constexpr std::uint8_t gimbal = 154;

/// Asks one component of the first vehicle.
std::optional<CommandAck> ask(TestGround& ground, std::uint8_t component, MavCmd number,
                              std::array<float, 7> params = {}) {
  auto const before = ground.heard.size();
  (void)ground.gcs.send({1, component}, CommandLong{.target = {}, .command = number, .params = params});
  ground.run_for(200ms);
  for (auto i = before; i < ground.heard.size(); ++i) {
    auto const* ack = std::get_if<CommandAck>(&ground.heard[i].message);
    if (ack && ground.heard[i].component == component) return *ack;
  }
  return std::nullopt;
}

TEST(PayloadOfPx4, HasHeartbeatsOfItsOwn) {
  TestGround ground("px4");
  ground.boot();
  ground.run_for(3s);
  auto const of_camera = ground.all<Heartbeat>(1, 0, camera);
  auto const of_gimbal = ground.all<Heartbeat>(1, 0, gimbal);
  ASSERT_GE(of_camera.size(), 5u);
  ASSERT_GE(of_gimbal.size(), 5u);
  EXPECT_EQ(of_camera.back().type, MavType::camera);
  EXPECT_EQ(of_camera.back().autopilot, MavAutopilot::invalid);
  EXPECT_EQ(of_gimbal.back().type, MavType::gimbal);
  EXPECT_EQ(ground.gcs.conflict(1), std::nullopt);
}

TEST(PayloadOfPx4, IsNotThereWhenParametersSaySo) {
  WorldOptions options;
  options.parameters = {{"TRIG_INTERFACE", 4}, {"MNT_MODE_OUT", 0}};
  TestGround ground("px4", options);
  ground.boot();
  EXPECT_TRUE(ground.all<Heartbeat>(1, 0, camera).empty());
  EXPECT_TRUE(ground.all<Heartbeat>(1, 0, gimbal).empty());
}

TEST(PayloadOfArduPilot, IsSpokenForByTheAutopilot) {
  TestGround ground("copter");
  ground.boot();
  EXPECT_TRUE(ground.all<Heartbeat>(1, 0, camera).empty());
  EXPECT_EQ(ground.command(MavCmd::request_message, {259}), MavResult::accepted);
}

TEST(PayloadOfPx4, TellsWhatItIs) {
  TestGround ground("px4");
  ground.boot();
  auto const ack = ask(ground, camera, MavCmd::request_message, {259});
  ASSERT_TRUE(ack);
  EXPECT_EQ(ack->result, MavResult::accepted);
  ASSERT_EQ(ground.all<CameraInformation>(1, 0, camera).size(), 1u);
  EXPECT_EQ(ground.all<CameraInformation>(1, 0, camera)[0].model, "simulated camera");
  EXPECT_EQ(ask(ground, gimbal, MavCmd::request_message, {259})->result, MavResult::denied);
  EXPECT_EQ(ask(ground, camera, MavCmd::component_arm_disarm, {1})->result, MavResult::unsupported);
  EXPECT_FALSE(ground.pilot().armed()) << "what is meant for a camera arms nothing";
}

TEST(PayloadOfPx4, TakesPicturesAndTellsOfEach) {
  TestGround ground("px4");
  ground.boot();
  EXPECT_EQ(ask(ground, camera, MavCmd::image_start_capture, {0, 1, 3})->result, MavResult::accepted);
  ground.run_for(5s);
  EXPECT_EQ(ground.all<CameraImageCaptured>(1, 0, camera).size(), 3u);
  EXPECT_TRUE(ground.all<CameraImageCaptured>().empty());
  EXPECT_EQ(ask(ground, camera, MavCmd::request_message, {263, 1})->result, MavResult::accepted);
  EXPECT_EQ(ground.all<CameraImageCaptured>(1, 0, camera).back().image, 1);
}

TEST(PayloadOfPx4, IsTurnedThroughTheAutopilotThatManagesIt) {
  TestGround ground("px4");
  ground.boot();
  EXPECT_EQ(ground.command(MavCmd::request_message, {280}), MavResult::accepted);
  ASSERT_EQ(ground.all<GimbalManagerInformation>().size(), 1u);
  EXPECT_EQ(ground.last<GimbalManagerInformation>()->gimbal_device, gimbal);
  EXPECT_EQ(ground.command(MavCmd::do_gimbal_manager_pitchyaw, {-45, 0}), MavResult::accepted);
  ground.run_for(3s);
  ASSERT_FALSE(ground.all<GimbalDeviceAttitudeStatus>(1, 0, gimbal).empty());
  auto const q = ground.all<GimbalDeviceAttitudeStatus>(1, 0, gimbal).back().orientation.value();
  EXPECT_NEAR(2.0 * std::asin(static_cast<double>(q[2])), -0.785, 0.01);
}

}  // namespace
}  // namespace lapwing::sim
