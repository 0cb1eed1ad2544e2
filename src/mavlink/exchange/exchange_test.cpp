#include <gtest/gtest.h>

#include "mavlink/exchange/message_interval.hpp"
#include "mavlink/testing/fake_vehicle.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::mavlink {
namespace {

using namespace testing;

TEST(MessageInterval, AsksInMicroseconds) {
  Bench bench;
  bench.vehicle->on = [&](Message const& message) {
    if (auto const* command = std::get_if<CommandLong>(&message))
      bench.vehicle->answer(CommandAck{.command = command->command});
  };
  EXPECT_TRUE(bench.loop.run_until_done(
      set_message_interval(bench.ground, Bench::target, MessageId::global_position_int, 200ms)));
  EXPECT_TRUE(bench.loop.run_until_done(reset_message_interval(bench.ground, Bench::target, MessageId::attitude)));
  auto const sent = bench.vehicle->all<CommandLong>();
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[0].params[0], 33.0F);
  EXPECT_EQ(sent[0].params[1], 200'000.0F);
  EXPECT_EQ(sent[1].params[1], 0.0F);
}

TEST(Modes, NameNumbersAndBack) {
  EXPECT_EQ(mode_name(Autopilot::ardupilot, Family::copter, 3), "AUTO");
  EXPECT_EQ(mode_name(Autopilot::ardupilot, Family::plane, 10), "AUTO");
  EXPECT_EQ(mode_name(Autopilot::ardupilot, Family::boat, 4), "HOLD");
  EXPECT_EQ(mode_name(Autopilot::ardupilot, Family::copter, 99), "mode 99");
  EXPECT_EQ(mode_name(Autopilot::px4, Family::copter, 4U << 16U | 5U << 24U), "AUTO.RTL");
  EXPECT_EQ(mode_name(Autopilot::px4, Family::copter, 9U << 16U | 1U << 24U), "mode 9.1");
  EXPECT_EQ(mode_name(Autopilot::other, Family::copter, 3), "mode 3");
  EXPECT_EQ(mode_number(Autopilot::ardupilot, Family::rover, "smart_rtl"), 12u);
  EXPECT_FALSE(mode_number(Autopilot::ardupilot, Family::rover, "LAND"));
}

TEST(Modes, ServeRoles) {
  EXPECT_EQ(mode_for(Autopilot::ardupilot, Family::copter, ModeRole::hold), 17u) << "LOITER without RC input sinks";
  EXPECT_EQ(mode_for(Autopilot::ardupilot, Family::plane, ModeRole::hold), 12u);
  EXPECT_EQ(mode_for(Autopilot::ardupilot, Family::rover, ModeRole::hold), 4u);
  EXPECT_EQ(mode_for(Autopilot::ardupilot, Family::rover, ModeRole::mission), 10u);
  EXPECT_FALSE(mode_for(Autopilot::ardupilot, Family::rover, ModeRole::land));
  EXPECT_FALSE(mode_for(Autopilot::ardupilot, Family::sub, ModeRole::rtl));
  EXPECT_EQ(mode_for(Autopilot::px4, Family::copter, ModeRole::mission), 4U << 16U | 4U << 24U);
  EXPECT_FALSE(mode_for(Autopilot::other, Family::copter, ModeRole::rtl));
}

TEST(Modes, MakeNoVehicleOfOtherThings) {
  for (auto const type : {MavType::gcs, MavType::gimbal, MavType::adsb, MavType::antenna_tracker, MavType::camera,
                          MavType::onboard_controller})
    EXPECT_EQ(family_of(type), Family::unknown);
  EXPECT_EQ(family_of(MavType::hexarotor), Family::copter);
  EXPECT_EQ(family_of(MavType::vtol_tiltrotor), Family::vtol);
}

}  // namespace
}  // namespace lapwing::mavlink
