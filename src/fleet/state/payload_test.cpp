#include "fleet/state/payload.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "fleet/state/components.hpp"
#include "fleet/testing/world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavType;
using mavlink::MessageId;

mavlink::Heartbeat heartbeat(MavType type, mavlink::MavState state = mavlink::MavState::active) {
  return {.type = type, .autopilot = mavlink::MavAutopilot::invalid, .system_status = state};
}

mavlink::CameraImageCaptured captured(std::int32_t image) {
  mavlink::CameraImageCaptured message;
  message.image = image;
  message.captured = true;
  message.position = TestAutopilot::home;
  return message;
}

/// Every REQUEST_MESSAGE that was heard, by id and argument.
std::vector<std::pair<int, int>> requests(TestAutopilot const& vehicle) {
  std::vector<std::pair<int, int>> all;
  for (auto const& message : vehicle.heard) {
    auto const* command = std::get_if<mavlink::CommandLong>(&message);
    if (command && command->command == mavlink::MavCmd::request_message)
      all.emplace_back(static_cast<int>(command->params[0]), static_cast<int>(command->params[1]));
  }
  return all;
}

TEST(ComponentKind, GoesByTypeThenByNumber) {
  EXPECT_EQ(component_kind({1, 191}, heartbeat(MavType::onboard_controller)), "companion computer");
  EXPECT_EQ(component_kind({1, 77}, heartbeat(MavType::gimbal)), "gimbal");
  EXPECT_EQ(component_kind({1, 101}, heartbeat(MavType::generic)), "camera");
  EXPECT_EQ(component_kind({1, 77}, heartbeat(MavType::generic)), "component");
  EXPECT_EQ(component_kind({1, 190}, heartbeat(MavType::gcs)), "");
  EXPECT_EQ(component_kind({1, 1}, heartbeat(MavType::quadrotor)), "");
}

TEST(Components, AreListedWithStateAndAge) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(1s);
  copter.send_as({1, 154}, heartbeat(MavType::gimbal, mavlink::MavState::standby));
  copter.send_as({1, 191}, heartbeat(MavType::onboard_controller));
  world.run_for(100ms);
  auto const& all = world.state().payload.components;
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].id, 154);
  EXPECT_EQ(all[0].kind, "gimbal");
  EXPECT_EQ(all[0].state, "standby");
  EXPECT_EQ(all[1].kind, "companion computer");
  auto const heard = all[0].heard;
  world.run_for(5s);
  EXPECT_EQ(world.state().payload.components[0].heard, heard);
  copter.send_as({1, 154}, heartbeat(MavType::gimbal, mavlink::MavState::critical));
  world.run_for(100ms);
  EXPECT_GT(world.state().payload.components[0].heard, heard);
  EXPECT_EQ(world.state().payload.components[0].state, "critical");
}

TEST(Components, AreBoundedInNumber) {
  std::vector<vehicle::Component> all;
  for (int id = 2; id <= 250; ++id) (void)component_of(all, id, "component");
  EXPECT_EQ(all.size(), 32u);
  EXPECT_EQ(component_of(all, 250, "component"), nullptr);
  EXPECT_NE(component_of(all, 2, "component"), nullptr);
}

TEST(Components, AreAskedWhatTheyAreOnce) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(10s);
  EXPECT_EQ(requests(copter), (std::vector<std::pair<int, int>>{{280, 0}, {259, 0}}));
  copter.send(mavlink::CameraInformation{.vendor = "Maker", .model = "M1"});
  world.run_for(1s);
  ASSERT_EQ(world.state().payload.components.size(), 1u);
  EXPECT_EQ(world.state().payload.components[0].model, "Maker M1");
  EXPECT_LT(world.loop.now() - world.state().payload.components[0].heard,
            2s);  // as old as the autopilot that speaks for it
  EXPECT_EQ(requests(copter).size(), 2u);
}

TEST(Gimbal, IsAskedForItsAttitudeWhereThereIsOne) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(10s);
  auto const asks = [&] {
    return std::ranges::count(copter.messages_asked_for(), MessageId::gimbal_device_attitude_status);
  };
  EXPECT_EQ(asks(), 0);
  copter.send(mavlink::GimbalManagerInformation{.gimbal_device = 1});
  world.run_for(5s);
  EXPECT_GE(asks(), 1);
}

TEST(Gimbal, PointsWhereItsQuaternionSays) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(1s);
  auto const half = static_cast<float>(std::numbers::pi / 8.0);  // of 45 degrees
  mavlink::GimbalDeviceAttitudeStatus status;
  status.orientation = {std::cos(half), 0.0F, -std::sin(half), 0.0F};
  copter.send(status);
  world.run_for(100ms);
  ASSERT_TRUE(world.state().payload.gimbal.known());
  EXPECT_NEAR(world.state().payload.gimbal.value->pitch_rad, -std::numbers::pi / 4.0, 1e-6);
  EXPECT_FALSE(world.state().payload.gimbal.value->yaw_is_from_north);

  auto const quarter = static_cast<float>(std::numbers::sqrt2 / 2.0);
  status.orientation = {quarter, 0.0F, -quarter, 0.0F};  // straight down
  status.flags = mavlink::gimbal_flag::yaw_lock;
  copter.send_as({1, 154}, status);
  world.run_for(100ms);
  EXPECT_NEAR(world.state().payload.gimbal.value->pitch_rad, -std::numbers::pi / 2.0, 0.02);
  EXPECT_EQ(world.state().payload.gimbal.value->roll_rad, 0.0);
  EXPECT_TRUE(world.state().payload.gimbal.value->yaw_is_from_north);

  status.orientation = {NAN, 0, 0, 0};
  copter.send(status);
  copter.send(mavlink::MountStatus{.pitch_rad = 0.5, .roll_rad = 0.0, .yaw_rad = 0.0});  // says less
  world.run_for(100ms);
  EXPECT_NEAR(world.state().payload.gimbal.value->pitch_rad, -std::numbers::pi / 2.0, 0.02);
  world.run_for(6s);
  copter.send(mavlink::MountStatus{.pitch_rad = 0.5, .roll_rad = 0.0, .yaw_rad = 0.0});
  world.run_for(100ms);
  EXPECT_NEAR(world.state().payload.gimbal.value->pitch_rad, 0.5, 1e-3);
}

TEST(Pictures, AreAskedForAgainWhenTheyWereLost) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(10s);
  copter.send(captured(4));
  copter.send(captured(6));
  world.run_for(500ms);
  auto const asked = requests(copter);
  EXPECT_EQ(asked.back(), (std::pair<int, int>{263, 5}));
  // It knows the older command only, as cameras before 2022.
  EXPECT_EQ(copter.commands_heard(mavlink::MavCmd::request_camera_image_capture), 1);
  EXPECT_EQ(world.state().payload.pictures.value->lost, 1);
  copter.send(captured(5));
  world.run_for(100ms);
  EXPECT_EQ(world.state().payload.pictures.value->lost, 0);
  EXPECT_EQ(world.state().payload.pictures.value->taken, 3);
}

TEST(ModeNames, AreTheVehiclesOwnWhereNoTableKnowsThem) {
  TestWorld world;
  auto& copter = world.add();
  copter.change_mode(4242);
  world.run_for(2s);
  EXPECT_EQ(world.state().mode.value, "mode 4242");
  EXPECT_EQ(std::ranges::count(requests(copter), std::pair(435, 0)), 1);
  copter.send(mavlink::AvailableModes{.count = 2, .index = 2, .custom_mode = 4242, .name = "Spiral"});
  world.run_for(100ms);
  EXPECT_EQ(world.state().mode.value, "Spiral");
  copter.change_mode(copter_mode::guided);
  world.run_for(1500ms);
  EXPECT_EQ(world.state().mode.value, "GUIDED");
  copter.change_mode(4242);
  world.run_for(1500ms);
  EXPECT_EQ(world.state().mode.value, "Spiral");
  EXPECT_EQ(std::ranges::count(requests(copter), std::pair(435, 0)), 1);
}

TEST(ModeList, TellsWhatOfItWasLostAndBeginsAnewWhenItChanges) {
  ModeList modes;
  EXPECT_TRUE(modes.missing().empty());
  modes.take(mavlink::AvailableModes{.count = 3, .index = 2, .custom_mode = 7, .name = "B"});
  EXPECT_EQ(modes.missing(), (std::vector<std::uint8_t>{1, 3}));
  EXPECT_EQ(modes.name(7), "B");
  EXPECT_FALSE(modes.name(8));
  EXPECT_FALSE(modes.take(mavlink::AvailableModesMonitor{.seq = 1}));
  EXPECT_FALSE(modes.take(mavlink::AvailableModesMonitor{.seq = 1}));
  EXPECT_EQ(modes.name(7), "B");
  EXPECT_TRUE(modes.take(mavlink::AvailableModesMonitor{.seq = 2}));
  EXPECT_FALSE(modes.name(7));
}

}  // namespace
}  // namespace lapwing::fleet
