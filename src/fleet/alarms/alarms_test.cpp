#include "fleet/alarms/alarms.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using vehicle::Alarm;
using vehicle::AlarmKind;
using vehicle::Severity;

struct AlarmWorld : ControlWorld {
  [[nodiscard]] std::vector<Alarm> const& alarms() const { return fleet->alarms().alarms(); }
  [[nodiscard]] Alarm const* find(AlarmKind kind) const {
    auto const found = std::ranges::find(alarms(), kind, &Alarm::kind);
    return found == alarms().end() ? nullptr : &*found;
  }
  [[nodiscard]] bool raises(AlarmKind kind, base::Duration limit = 5s) {
    return run_until([&] { return find(kind) != nullptr; }, limit);
  }
  [[nodiscard]] bool clears(AlarmKind kind, base::Duration limit = 5s) {
    return run_until([&] { return find(kind) == nullptr; }, limit);
  }
  [[nodiscard]] long count_logged(std::string_view part) const {
    return std::ranges::count_if(lines, [part](auto const& line) { return line.contains(part); });
  }
  std::size_t acknowledge(AlarmKind kind, std::string by = "operator 1") {
    std::uint64_t const number = find(kind) ? find(kind)->number : 0;
    return fleet->alarms().acknowledge(std::span(&number, 1), std::move(by));
  }
  void drain(TestAutopilot& copter, double to, std::uint8_t charge_state = 0) {
    copter.battery = to;
    copter.send(mavlink::BatteryStatus{.voltage_v = 14.0, .remaining = to, .charge_state = charge_state});
  }
};

TEST(Alarms, TellOfASilentVehicleWithinThreeSeconds) {
  AlarmWorld world;
  auto& copter = world.add_flying();
  EXPECT_EQ(world.find(AlarmKind::silent), nullptr);
  copter.is_silent = true;
  auto const since = world.loop.now();
  ASSERT_TRUE(world.raises(AlarmKind::silent));
  EXPECT_LE(world.loop.now() - since, 3s);
  EXPECT_TRUE(world.state().links.is_silent);
  EXPECT_EQ(world.state().links.connection, vehicle::Connection::ok) << "for scripts it is lost after their time-out";
  EXPECT_EQ(world.find(AlarmKind::silent)->severity, Severity::critical);
  EXPECT_LE(world.find(AlarmKind::silent)->since, since);
  EXPECT_TRUE(world.has_logged("copter 1 silent, last known in the air at 0 m"));
}

TEST(Alarms, EndTheSilenceWithTheFirstMessage) {
  AlarmWorld world;
  auto& copter = world.add_ready();
  copter.is_silent = true;
  ASSERT_TRUE(world.raises(AlarmKind::silent));
  EXPECT_EQ(world.find(AlarmKind::silent)->severity, Severity::warning) << "it stood on the ground, disarmed";
  copter.is_silent = false;
  EXPECT_TRUE(world.clears(AlarmKind::silent, 1500ms));
  EXPECT_FALSE(world.state().links.is_silent);
  EXPECT_TRUE(world.has_logged("copter 1 is heard again after"));
}

TEST(Alarms, CallASilentVehicleLostAfterTheScriptsTimeOut) {
  AlarmWorld world;
  auto& copter = world.add_flying();
  copter.is_silent = true;
  ASSERT_TRUE(world.raises(AlarmKind::silent));
  EXPECT_EQ(world.acknowledge(AlarmKind::silent), 1U);
  ASSERT_TRUE(world.raises(AlarmKind::lost, 30s));
  EXPECT_EQ(world.find(AlarmKind::silent), nullptr) << "one alarm for one link";
  EXPECT_EQ(world.find(AlarmKind::lost)->acknowledged_by, "") << "to be lost is news";
  EXPECT_FALSE(world.has_logged("is heard again"));
  copter.is_silent = false;
  EXPECT_TRUE(world.clears(AlarmKind::lost));
  EXPECT_TRUE(world.has_logged("copter 1 is back at "));
}

TEST(Alarms, TakeNoLossyLinkForASilentOne) {
  AlarmWorld world;
  world.add({}, {.loss = 0.3, .seed = 7});
  world.run_for(120s);
  EXPECT_EQ(world.count_logged("silent"), 0);
}

TEST(Alarms, TakeTwoLostHeartbeatsOfAThinLinkForNoSilence) {
  TestWorld world({.asks_for_messages = false});
  auto& copter = world.add();
  world.run_for(20100ms);
  copter.is_silent = true;
  EXPECT_FALSE(world.run_until([&] { return world.state().links.is_silent; }, 2800ms));
  copter.is_silent = false;
  EXPECT_FALSE(world.run_until([&] { return world.state().links.is_silent; }, 10s));
  copter.is_silent = true;
  EXPECT_TRUE(world.run_until([&] { return world.state().links.is_silent; }, 4s));
}

TEST(Alarms, SayThatAFleetIsSilentInOneLine) {
  AlarmWorld world;
  for (std::uint8_t id = 1; id <= 100; ++id) world.add({.address = {id, 1}});
  world.run_for(5s);
  world.lines.clear();
  for (auto& vehicle : world.vehicles) vehicle->is_silent = true;
  world.run_for(6s);
  EXPECT_EQ(world.alarms().size(), 100U);
  EXPECT_LE(world.count_logged("silent"), 2);
  world.run_for(20s);
  EXPECT_LE(world.count_logged("lost"), 3);
  EXPECT_TRUE(world.has_logged("vehicles lost: copter "));
  world.lines.clear();
  for (auto& vehicle : world.vehicles) vehicle->is_silent = false;
  world.run_for(4s);
  EXPECT_TRUE(world.alarms().empty());
  EXPECT_LE(world.count_logged("no longer lost"), 3);
}

TEST(Alarms, NameBothOfAConflict) {
  AlarmWorld world;
  world.add();
  world.add();
  ASSERT_TRUE(world.raises(AlarmKind::conflict, 15s));
  EXPECT_TRUE(world.find(AlarmKind::conflict)->words.starts_with("two vehicles use system id 1: "));
}

TEST(Alarms, GoByTheVehiclesOwnWordForItsBattery) {
  AlarmWorld world;
  auto& copter = world.add_flying();
  constexpr std::uint8_t low = 2;
  constexpr std::uint8_t critical = 3;
  world.drain(copter, 0.6, low);
  ASSERT_TRUE(world.raises(AlarmKind::battery_low));
  EXPECT_EQ(world.find(AlarmKind::battery_low)->words, "copter 1 battery low: 60 % left");
  world.drain(copter, 0.5, critical);
  ASSERT_TRUE(world.raises(AlarmKind::battery_critical));
  EXPECT_EQ(world.find(AlarmKind::battery_low), nullptr);
  EXPECT_FALSE(world.has_logged("over: copter 1 battery low")) << "it is worse, not over";
  EXPECT_EQ(world.find(AlarmKind::battery_critical)->severity, Severity::critical);
}

TEST(Alarms, GoByTheLimitsWhereABatteryHasNoWord) {
  AlarmWorld world;
  auto& copter = world.add_flying();
  world.drain(copter, 0.31);
  world.run_for(1s);
  EXPECT_EQ(world.find(AlarmKind::battery_low), nullptr);
  world.drain(copter, 0.29);
  ASSERT_TRUE(world.raises(AlarmKind::battery_low));
  auto const number = world.find(AlarmKind::battery_low)->number;
  world.drain(copter, 0.305);
  world.run_for(1s);
  world.drain(copter, 0.28);
  world.run_for(1s);
  ASSERT_NE(world.find(AlarmKind::battery_low), nullptr);
  EXPECT_EQ(world.find(AlarmKind::battery_low)->number, number) << "a charge that wavers raises no second alarm";
  world.drain(copter, 0.9);
  EXPECT_TRUE(world.clears(AlarmKind::battery_low));
}

TEST(Alarms, GiveAFailsafeInTheVehiclesWordsForAsLongAsItActs) {
  AlarmWorld world;
  auto& copter = world.add_flying();
  auto const beat = [&](mavlink::MavState status) {
    copter.send(mavlink::Heartbeat{.type = mavlink::MavType::quadrotor,
                                   .autopilot = mavlink::MavAutopilot::ardupilotmega,
                                   .base_mode = 0x81,
                                   .custom_mode = copter_mode::guided,
                                   .system_status = status});
  };
  copter.say(mavlink::MavSeverity::warning, "Radio Failsafe - RTL");
  ASSERT_TRUE(world.raises(AlarmKind::failsafe));
  EXPECT_EQ(world.find(AlarmKind::failsafe)->words, "copter 1 failsafe: Radio Failsafe - RTL");
  world.acknowledge(AlarmKind::failsafe);
  copter.say(mavlink::MavSeverity::warning, "Battery 1 Failsafe - Land");
  ASSERT_TRUE(world.run_until([&] { return world.find(AlarmKind::failsafe)->acknowledged_by.empty(); }))
      << "another failsafe is another alarm";
  copter.say(mavlink::MavSeverity::info, "Failsafe Cleared");
  EXPECT_TRUE(world.clears(AlarmKind::failsafe));
  EXPECT_TRUE(world.run_until(
      [&] {
        beat(mavlink::MavState::critical);
        return world.find(AlarmKind::failsafe) != nullptr;
      },
      2s))
      << "a vehicle that says no word but is in trouble";
}

TEST(Alarms, TellOfABreachedFenceUntilItIsWhole) {
  AlarmWorld world;
  auto& copter = world.add_flying();
  copter.send(mavlink::FenceStatus{.breached = true, .breach_count = 1, .breach_type = 3});
  ASSERT_TRUE(world.raises(AlarmKind::fence));
  EXPECT_EQ(world.find(AlarmKind::fence)->words, "copter 1 fence breached: boundary");
  copter.send(mavlink::FenceStatus{.breached = false, .breach_count = 1, .breach_type = 0});
  EXPECT_TRUE(world.clears(AlarmKind::fence));
}

TEST(Alarms, TellOfAModeThatThePilotChose) {
  AlarmWorld world;
  auto& copter = world.add_ready();
  auto const number = world.give({.action = vehicle::Action::take_off, .height_m = 10.0});
  ASSERT_EQ(world.end_of(number), vehicle::CommandState::confirmed);
  world.run_for(2s);
  EXPECT_EQ(world.find(AlarmKind::foreign_mode), nullptr) << "what was asked for here is no alarm";
  copter.change_mode(copter_mode::stabilize);
  ASSERT_TRUE(world.raises(AlarmKind::foreign_mode));
  EXPECT_EQ(world.find(AlarmKind::foreign_mode)->words,
            "copter 1 changed its mode: GUIDED to STABILIZE, not asked for here");
  (void)world.give({.action = vehicle::Action::hold});
  EXPECT_TRUE(world.clears(AlarmKind::foreign_mode)) << "an operator's command is the end of it";
}

TEST(Alarms, TakeTheEndOfAMissionForNobodysMode) {
  AlarmWorld world;
  auto& rover = world.add_ready(a_rover(1));
  rover.is_armed = true;
  rover.change_mode(rover_mode::automatic);
  rover.send(mavlink::MissionCurrent{.seq = 4, .total = 5});
  world.run_for(2s);
  rover.change_mode(rover_mode::hold);
  world.run_for(3s);
  EXPECT_EQ(world.state().mode.value, "HOLD");
  EXPECT_FALSE(world.state().foreign_mode.known());
}

TEST(Alarms, TellOfAVehicleThatWasLeftArmed) {
  AlarmWorld world;
  auto& rover = world.add_ready(a_rover(1));
  auto const number = world.give({.action = vehicle::Action::arm});
  ASSERT_EQ(world.end_of(number), vehicle::CommandState::confirmed);
  world.run_for(20s);
  EXPECT_EQ(world.find(AlarmKind::left_armed), nullptr) << "it has a commander";
  ASSERT_TRUE(world.control->yield_control(vehicle::VehicleId{"1"}, "operator 1"));
  ASSERT_TRUE(world.raises(AlarmKind::left_armed, 15s));
  rover.disarm();
  EXPECT_TRUE(world.clears(AlarmKind::left_armed));
}

TEST(Alarms, StandQuietlyOnceAcknowledged) {
  AlarmWorld world;
  auto& copter = world.add_ready();
  copter.is_silent = true;
  ASSERT_TRUE(world.raises(AlarmKind::silent));
  auto const before = world.fleet->alarms().revision();
  EXPECT_EQ(world.acknowledge(AlarmKind::silent, "operator 2"), 1U);
  EXPECT_EQ(world.find(AlarmKind::silent)->acknowledged_by, "operator 2");
  EXPECT_GT(world.fleet->alarms().revision(), before);
  EXPECT_EQ(world.acknowledge(AlarmKind::silent, "operator 1"), 0U) << "it has been";
  EXPECT_TRUE(world.has_logged("operator 2 acknowledged 1 alarm"));
  world.run_for(10s);
  EXPECT_EQ(world.alarms().size(), 1U) << "it stands until it is over";
}

}  // namespace
}  // namespace lapwing::fleet
