#include "mavlink/codec/codec.hpp"

#include <cmath>
#include <fstream>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mavlink/testing/frame_bytes.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

struct Golden {
  std::string name;
  Data bytes;
};

std::vector<Golden> golden_frames() {
  std::ifstream file(LAPWING_SOURCE_DIR "/tests/golden/mavlink/frames.txt");
  std::vector<Golden> all;
  std::string name;
  std::string hex;
  while (file >> name >> hex) {
    Golden golden{name, {}};
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
      golden.bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    all.push_back(std::move(golden));
  }
  return all;
}

/// Through the wire and back.
template <class M>
M carried(M const& message) {
  auto const decoded = decode(encode(message, {1, 1}, 0));
  return std::get<M>(decoded.value());
}

TEST(Codec, ReadsAndRewritesWhatPymavlinkPacks) {
  auto const frames = golden_frames();
  ASSERT_GT(frames.size(), 50u);
  std::set<std::size_t> kinds;
  for (auto const& golden : frames) {
    auto const frame = parsed(golden.bytes);
    auto const message = decode(frame);
    ASSERT_TRUE(message) << golden.name;
    kinds.insert(message->index());
    EXPECT_EQ(bytes_of(encode(*message, frame.source, frame.seq)), golden.bytes) << golden.name;
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<Message>) << "every kind of message has a golden frame";
}

TEST(Codec, IsStableForEveryMessageWithAnyPayload) {
  // What was decoded once is encoded without further change, whatever bytes came first.
  std::mt19937 random(3);
  for (auto const& golden : golden_frames()) {
    auto frame = parsed(golden.bytes);
    for (int i = 0; i < 200; ++i) {
      for (auto& byte : frame.payload)
        byte = static_cast<std::uint8_t>(random() % 3 == 0 ? random() % 2 * 255 : random());
      auto const first = decode(frame);
      ASSERT_TRUE(first) << golden.name;
      auto const again = encode(*first, frame.source, 0);
      auto const second = decode(again);
      ASSERT_TRUE(second) << golden.name;
      EXPECT_EQ(bytes_of(encode(*second, frame.source, 0)), bytes_of(again)) << golden.name;
    }
  }
}

TEST(Codec, GivesNothingForMessagesThatAreNotUsed) {
  Frame frame;
  frame.message_id = 27;  // RAW_IMU
  EXPECT_FALSE(decode(frame));
  frame.message_id = 60000;
  EXPECT_FALSE(decode(frame));
}

TEST(Codec, TurnsWireUnitsIntoSi) {
  GlobalPosition position;
  position.since_boot = std::chrono::milliseconds(1500);
  position.position = geo::Wgs84::from_degrees(40.4451294, -7.3728766, 820.25);
  position.relative_alt_m = -1.5;
  position.velocity_m_s = geo::Ned{3.25, -4.5, 0.01};
  position.heading_rad = 1.0;
  auto const got = carried(position);
  EXPECT_EQ(got.since_boot, position.since_boot);
  EXPECT_NEAR(got.position->lat_deg(), 40.4451294, 1e-12);
  EXPECT_NEAR(got.position->lon_deg(), -7.3728766, 1e-12);
  EXPECT_DOUBLE_EQ(got.position->alt_m, 820.25);
  EXPECT_DOUBLE_EQ(*got.relative_alt_m, -1.5);
  EXPECT_NEAR(got.velocity_m_s->north, 3.25, 1e-9);
  EXPECT_NEAR(got.velocity_m_s->down, 0.01, 1e-9);
  EXPECT_NEAR(*got.heading_rad, 1.0, 1e-4);
}

TEST(Codec, KeepsTheUnknownUnknown) {
  EXPECT_FALSE(carried(GlobalPosition{}).heading_rad);
  auto const status = carried(SysStatus{});
  EXPECT_FALSE(status.battery_voltage_v);
  EXPECT_FALSE(status.battery_current_a);
  EXPECT_FALSE(status.battery_remaining);
  auto const battery = carried(BatteryStatus{});
  EXPECT_FALSE(battery.voltage_v || battery.current_a || battery.consumed_ah || battery.remaining);
  EXPECT_FALSE(battery.temperature_c || battery.time_remaining);
  auto const gps = carried(GpsRaw{});
  EXPECT_FALSE(gps.hdop || gps.vdop || gps.ground_speed_m_s || gps.course_rad || gps.satellites);
  EXPECT_FALSE(carried(RcChannels{}).rssi);
  EXPECT_FALSE(carried(GimbalDeviceAttitudeStatus{}).delta_yaw_rad);
  EXPECT_FALSE(carried(MissionCurrent{.seq = 1}).total);
  EXPECT_EQ(carried(MissionCurrent{.seq = 0, .total = 0}).total, 0);
  EXPECT_FALSE(carried(CommandAck{.result = MavResult::in_progress}).progress);
}

TEST(Codec, CarriesTheNamesOfPlansThatTheDialectDoesNotKnowYet) {
  EXPECT_EQ(carried(MissionCount{.count = 3, .opaque_id = 0xDEADBEEF}).opaque_id, 0xDEADBEEFU);
  EXPECT_EQ(carried(MissionAck{.opaque_id = 0x01020304}).opaque_id, 0x01020304U);
  auto const current =
      carried(MissionCurrent{.seq = 1, .total = 4, .mission_id = 7, .fence_id = 0, .rally_id = 0xFF000000});
  EXPECT_EQ(current.total, 4);
  EXPECT_EQ(current.mission_id, 7U);
  EXPECT_EQ(current.fence_id, 0U);
  EXPECT_EQ(current.rally_id, 0xFF000000U);
  EXPECT_EQ(carried(MissionCount{.count = 3}).opaque_id, 0U);
}

TEST(Codec, KeepsAHeadingJustBelowNorthWithinTheCircle) {
  GlobalPosition position;
  position.heading_rad = 2 * std::numbers::pi - 1e-9;
  EXPECT_DOUBLE_EQ(*carried(position).heading_rad, 0.0);
  position.heading_rad = -std::numbers::pi / 2;
  EXPECT_NEAR(*carried(position).heading_rad, 1.5 * std::numbers::pi, 1e-9);
}

TEST(Codec, ClampsWhatTheWireCannotHold) {
  EXPECT_EQ(carried(NavControllerOutput{.waypoint_distance_m = 1e6}).waypoint_distance_m, 65535.0);
  EXPECT_EQ(carried(NavControllerOutput{.waypoint_distance_m = -1.0}).waypoint_distance_m, 0.0);
  EXPECT_EQ(carried(NavControllerOutput{.waypoint_distance_m = std::nan("")}).waypoint_distance_m, 0.0);
}

TEST(Codec, CarriesVoltagesBeyondOneField) {
  EXPECT_NEAR(*carried(BatteryStatus{.voltage_v = 88.8}).voltage_v, 88.8, 1e-9);
}

TEST(Codec, KeepsEnumValuesThatItHasNoNameFor) {
  auto const got =
      carried(Heartbeat{.type = MavType{200}, .autopilot = MavAutopilot{99}, .system_status = MavState{77}});
  EXPECT_EQ(got.type, MavType{200});
  EXPECT_EQ(got.autopilot, MavAutopilot{99});
  EXPECT_EQ(got.system_status, MavState{77});
  EXPECT_EQ(carried(CommandAck{.command = MavCmd{31999}, .result = MavResult{55}}).result, MavResult{55});
}

TEST(Codec, PlacesItemsByFrameAndCommand) {
  MissionItem item{.seq = 2, .frame = MavFrame::global_relative_alt, .command = MavCmd::nav_waypoint};
  item.params = {0, 50, 0, std::nanf("")};
  item.place = {.lat_rad = 0.7, .lon_rad = -0.1, .z_m = 30};
  auto const place = carried(item).place;
  EXPECT_NEAR(place.lat_rad, 0.7, 1e-9);
  EXPECT_NEAR(place.lon_rad, -0.1, 1e-9);
  EXPECT_TRUE(std::isnan(carried(item).params[3]));

  item.command = MavCmd::do_digicam_control;  // 5 and 6 are plain numbers
  item.place = {.x = 1, .y = -3, .z_m = 0};
  EXPECT_EQ(carried(item).place.x, 1);
  EXPECT_EQ(carried(item).place.y, -3);

  item.frame = MavFrame::local_ned;
  item.command = MavCmd::nav_waypoint;
  item.place = {.x = 12.3456, .y = -0.5, .z_m = -20};
  EXPECT_NEAR(carried(item).place.x, 12.3456, 1e-9);
}

TEST(Codec, CarriesTheDeprecatedFloatFormToAboutAMetre) {
  MissionItem item{.frame = MavFrame::global, .command = MavCmd::nav_waypoint, .form = ItemForm::floating};
  item.place = {.lat_rad = 0.7, .lon_rad = -0.1, .z_m = 30};
  auto const got = carried(item);
  EXPECT_EQ(got.form, ItemForm::floating);
  EXPECT_NEAR(got.place.lat_rad, 0.7, 2e-7);
}

TEST(Codec, CutsTextsAtTheirField) {
  EXPECT_EQ(carried(StatusText{.text = std::string(60, 'x')}).text, std::string(50, 'x'));
  EXPECT_EQ(carried(ParamSet{.name = "A_NAME_THAT_IS_TOO_LONG"}).name, "A_NAME_THAT_IS_T");
  EXPECT_EQ(carried(StatusText{.text = ""}).text, "");
}

TEST(Codec, LetsNoControlCharactersIn) {
  EXPECT_EQ(carried(StatusText{.text = "a\x1b[31m\nb\xc2\x9b"}).text, "a?[31m?b?");
  EXPECT_EQ(carried(ParamValue{.name = "A\tB"}).name, "A?B");
}

TEST(Codec, CarriesWhatCamerasAndGimbalsSay) {
  CameraImageCaptured image{.camera = 0, .position = geo::Wgs84::from_degrees(40.0, -8.0, 120.5)};
  image.image = 17;
  image.captured = true;
  image.file_url = "mavlinkftp:/17.jpg";
  auto const got = carried(image);
  EXPECT_EQ(got.image, 17);
  EXPECT_TRUE(got.captured);
  EXPECT_EQ(got.file_url, "mavlinkftp:/17.jpg");
  EXPECT_NEAR(got.position->lat_deg(), 40.0, 1e-9);
  EXPECT_EQ(carried(CameraInformation{.vendor = "Maker", .model = std::string(40, 'x')}).model, std::string(32, 'x'));
  EXPECT_NEAR(*carried(MountStatus{.pitch_rad = -1.5}).pitch_rad, -1.5, 1e-4);
  EXPECT_NEAR(*carried(RcChannels{.rssi = 0.5}).rssi, 0.5, 1e-9);
  EXPECT_EQ(carried(AvailableModes{.custom_mode = 77, .name = "Spiral"}).name, "Spiral");
}

TEST(SensorName, NamesEveryBitThatHasAName) {
  EXPECT_EQ(sensor_name(2), "compass");
  EXPECT_EQ(1U << 28U, sensor_flag::prearm_check);
  EXPECT_EQ(sensor_name(28), "arming checks");
  EXPECT_EQ(sensor_name(16), "RC receiver");
  EXPECT_EQ(sensor_name(30), "propulsion");
  EXPECT_EQ(sensor_name(31), "");
}

TEST(Message, KnowsItsTarget) {
  Message command = CommandLong{};
  set_target(command, {7, 1});
  EXPECT_EQ(target_of(command), (Address{7, 1}));
  Message mode = SetMode{};
  set_target(mode, {9, 1});
  EXPECT_EQ(target_of(mode), (Address{9, 0}));
  EXPECT_FALSE(target_of(Message(Heartbeat{})));
}

}  // namespace
}  // namespace lapwing::mavlink
