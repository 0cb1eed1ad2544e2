#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "mavlink/codec/codec.hpp"
#include "mavlink/testing/fake_vehicle.hpp"
#include "mavlink/wire/dialect_names.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

template <class T>
Frame with(Message const& honest, std::string_view message, std::string_view field, T value) {
  auto frame = encode(honest, {7, 1}, 0);
  auto const fields = find_message(message)->fields;
  for (auto const& known : fields)
    if (known.name == field) std::memcpy(frame.payload.data() + known.offset, &value, sizeof(value));
  return frame;
}

GlobalPosition here() {
  return {.position = geo::Wgs84::from_degrees(41.0, -8.0, 100.0),
          .relative_alt_m = 10.0,
          .velocity_m_s = geo::Ned{1.0, 0.0, 0.0},
          .heading_rad = 1.0};
}

template <class M>
M taken(Frame const& frame, std::vector<ImpossibleField>& left_out) {
  return std::get<M>(decode(frame, left_out).value());
}

TEST(ImpossibleField, IsAbsentAndTold) {
  std::vector<ImpossibleField> left_out;
  auto const frame = with(here(), "GLOBAL_POSITION_INT", "lat", std::int32_t{2'147'483'646});
  auto const position = taken<GlobalPosition>(frame, left_out);
  EXPECT_FALSE(position.position);
  EXPECT_EQ(position.relative_alt_m, 10.0) << "the rest of the message stays";
  ASSERT_EQ(left_out.size(), 1U);
  EXPECT_EQ(left_out[0].name, "lat");
  EXPECT_NEAR(left_out[0].value, 214.7483646 * std::numbers::pi / 180.0, 1e-9);
}

TEST(ImpossibleField, IsNotWhatMavlinkCallsUnknown) {
  std::vector<ImpossibleField> left_out;
  auto constexpr unknown = std::numeric_limits<std::int32_t>::max();
  for (auto const* field : {"lat", "lon", "alt"})
    EXPECT_FALSE(taken<GlobalPosition>(with(here(), "GLOBAL_POSITION_INT", field, unknown), left_out).position);
  EXPECT_FALSE(
      taken<GlobalPosition>(with(here(), "GLOBAL_POSITION_INT", "relative_alt", unknown), left_out).relative_alt_m);
  VfrHud const hud{.airspeed_m_s = 5.0,
                   .ground_speed_m_s = 5.0,
                   .heading_rad = 0.0,
                   .throttle = 0.0,
                   .alt_m = 0.0,
                   .climb_m_s = 0.0};
  EXPECT_FALSE(taken<VfrHud>(with(hud, "VFR_HUD", "airspeed", std::nanf("")), left_out).airspeed_m_s);
  EXPECT_TRUE(left_out.empty()) << left_out[0].name;
}

TEST(ImpossibleField, IsAnythingBeyondPhysics) {
  std::vector<ImpossibleField> left_out;
  EXPECT_FALSE(taken<SysStatus>(with(SysStatus{}, "SYS_STATUS", "battery_remaining", std::int8_t{-128}), left_out)
                   .battery_remaining);
  EXPECT_FALSE(
      taken<GlobalPosition>(
          with(here(), "GLOBAL_POSITION_INT", "relative_alt", std::numeric_limits<std::int32_t>::min()), left_out)
          .relative_alt_m);
  EXPECT_FALSE(taken<GlobalPosition>(
                   with(here(), "GLOBAL_POSITION_INT", "vy", std::numeric_limits<std::int16_t>::min()), left_out)
                   .velocity_m_s);
  EXPECT_FALSE(
      taken<Attitude>(with(Attitude{.roll_rad = 0.0}, "ATTITUDE", "roll", std::numeric_limits<float>::infinity()),
                      left_out)
          .roll_rad);
  EXPECT_FALSE(
      taken<CommandAck>(
          with(CommandAck{.result = MavResult::in_progress}, "COMMAND_ACK", "progress", std::uint8_t{200}), left_out)
          .progress);
  std::vector<std::string_view> names;
  for (auto const& field : left_out) names.push_back(field.name);
  EXPECT_EQ(names, (std::vector<std::string_view>{"battery_remaining", "relative_alt", "vy", "roll", "progress"}));
}

TEST(ImpossibleField, IsASpeedThatOnlyTheSumOfItsPartsGives) {
  std::vector<ImpossibleField> left_out;
  auto position = here();
  position.velocity_m_s = geo::Ned{290.0, 290.0, 0.0};
  EXPECT_FALSE(taken<GlobalPosition>(encode(position, {7, 1}, 0), left_out).velocity_m_s);
  ASSERT_EQ(left_out.size(), 1U);
  EXPECT_NEAR(left_out[0].value, 410.1, 0.1);
}

TEST(ImpossibleField, LeavesPolesAndTheDateLine) {
  std::vector<ImpossibleField> left_out;
  for (auto const lat : {-900'000'000, 900'000'000})
    EXPECT_TRUE(taken<GlobalPosition>(with(here(), "GLOBAL_POSITION_INT", "lat", lat), left_out).position) << lat;
  for (auto const lon : {-1'800'000'000, 1'800'000'000})
    EXPECT_TRUE(taken<GlobalPosition>(with(here(), "GLOBAL_POSITION_INT", "lon", lon), left_out).position) << lon;
  EXPECT_TRUE(left_out.empty());
}

TEST(ImpossibleField, IsNoAirspeedErrorInTheHundredthsOfAnArduPlane) {
  std::vector<ImpossibleField> left_out;
  auto const message = NavControllerOutput{.airspeed_error_m_s = 1021.1};  // it wants to be 10.2 m/s faster
  auto const told = taken<NavControllerOutput>(encode(message, {7, 1}, 0), left_out);
  EXPECT_TRUE(told.airspeed_error_m_s);
  EXPECT_TRUE(left_out.empty());
}

TEST(ImpossibleField, LeavesSetpointsThatOthersAskFor) {
  // An emergency stop must recognise a setpoint whatever it asks for.
  std::vector<ImpossibleField> left_out;
  auto const frame = with(SetPositionTargetGlobalInt{.target = {1, 1}}, "SET_POSITION_TARGET_GLOBAL_INT", "lat_int",
                          std::numeric_limits<std::int32_t>::max());
  EXPECT_TRUE(decode(frame, left_out));
  EXPECT_TRUE(left_out.empty());
}

/// A station that keeps what it logs, and the bare end of a vehicle's link.
struct Heard {
  Heard() {
    hub.add_sink([this](base::LogRecord const& record) { lines.push_back(record.text); });
    ground.add_link(pipes.take_server());
    vehicle->start([](link::Peer, link::Bytes) {});
  }
  void say(Frame frame) {
    frame.seq = seq++;
    vehicle->send(vehicle->standing_peers().front(), serialize(frame).bytes());
    run_for(1ms);
  }
  void run_for(base::Duration time) { loop.run_until_done(pass(loop, time)); }

  base::Loop loop{{.unpaced = true}};
  base::LogHub hub;
  std::vector<std::string> lines;
  link::PipeHub pipes{loop};
  Connection ground{loop, {}, base::Logger(hub, "mavlink")};
  Subscription listener = ground.subscribe([](Received const&) {});
  std::unique_ptr<link::ByteLink> vehicle = pipes.connect();
  std::uint8_t seq = 0;
};

TEST(Connection, CountsImpossibleValuesByMessageAndFieldAndTellsOfThemOnceAMinute) {
  Heard heard;
  auto const far_north = with(here(), "GLOBAL_POSITION_INT", "lat", std::int32_t{2'000'000'000});
  for (int i = 0; i < 100; ++i) heard.say(far_north);
  heard.say(with(SysStatus{}, "SYS_STATUS", "battery_remaining", std::int8_t{-128}));
  ASSERT_EQ(heard.lines.size(), 2U);
  EXPECT_EQ(heard.lines[0], "vehicle 7 tells what cannot be: GLOBAL_POSITION_INT.lat is 200 deg; left out");
  EXPECT_EQ(heard.lines[1], "vehicle 7 tells what cannot be: SYS_STATUS.battery_remaining is -1.28; left out");
  auto const counted = heard.ground.report().at(0).impossible_values;
  ASSERT_EQ(counted.size(), 2U);
  EXPECT_EQ(counted[1].message, "GLOBAL_POSITION_INT");
  EXPECT_EQ(counted[1].field, "lat");
  EXPECT_EQ(counted[1].count, 100U);
  EXPECT_EQ(counted[0].field, "battery_remaining");

  heard.run_for(1min);
  heard.say(far_north);
  ASSERT_EQ(heard.lines.size(), 3U);
  EXPECT_EQ(heard.lines[2],
            "vehicle 7 tells what cannot be: GLOBAL_POSITION_INT.lat is 200 deg; left out, 101 times so far");
}

TEST(Connection, TellsOfNoEndOfInventedVehiclesNothingMore) {
  Heard heard;
  auto frame = with(here(), "GLOBAL_POSITION_INT", "lat", std::int32_t{2'000'000'000});
  for (unsigned i = 0; i < 1000; ++i) {
    frame.source = {static_cast<std::uint8_t>(1 + i % 250), static_cast<std::uint8_t>(1 + i / 250)};
    heard.say(frame);
  }
  EXPECT_LE(heard.lines.size(), 300U);
  EXPECT_EQ(heard.ground.report().at(0).impossible_values.at(0).count, 1000U) << "all are counted";
}

}  // namespace
}  // namespace lapwing::mavlink
