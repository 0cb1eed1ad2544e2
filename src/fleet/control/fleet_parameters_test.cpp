#include "fleet/control/fleet_parameters.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "fleet/testing/control_world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::Message;

/// A copter with a hundred parameters, whose value 7 goes up to 50.
class Copter {
 public:
  Copter(base::Loop& loop, std::unique_ptr<link::ByteLink> link)
      : connection(loop, {.self = {1, mavlink::autopilot_component}, .heartbeat = [] { return heartbeat(); }}, {}),
        subscription_(connection.subscribe([this](mavlink::Received const& received) { take(received.message); })),
        scope_(loop) {
    connection.add_link(std::move(link));
  }

  mavlink::Connection connection;
  std::vector<float> values = std::vector<float>(100, 7.0F);
  int lists = 0;
  bool is_silent = false;

 private:
  static mavlink::Heartbeat heartbeat() {
    return {.type = mavlink::MavType::quadrotor, .autopilot = mavlink::MavAutopilot::ardupilotmega};
  }
  void take(Message const& message) {
    if (is_silent) return;
    if (auto const* command = std::get_if<mavlink::CommandLong>(&message);
        command && command->command == mavlink::MavCmd::request_message)
      connection.send_to_all(mavlink::AutopilotVersion{.flight_sw_version = 0x04060000U, .uid = 7});
    if (std::get_if<mavlink::ParamRequestList>(&message)) {
      ++lists;
      scope_.spawn(stream());
    }
    if (auto const* read = std::get_if<mavlink::ParamRequestRead>(&message)) {
      if (read->index >= 0) return tell(static_cast<std::size_t>(read->index), static_cast<std::uint16_t>(read->index));
      if (read->name.starts_with('P')) tell(static_cast<std::size_t>(std::stoi(read->name.substr(1))), 65535);
    }
    if (auto const* set = std::get_if<mavlink::ParamSet>(&message)) {
      auto const i = static_cast<std::size_t>(std::stoi(set->name.substr(1)));
      values[i] = i == 7 ? std::min(set->value, 50.0F) : set->value;
      tell(i, 65535);
    }
  }
  void tell(std::size_t i, std::uint16_t index) {
    connection.send_to_all(
        mavlink::ParamValue{.name = "P" + std::to_string(i),
                            .value = values[i],
                            .type = i == 3 ? mavlink::MavParamType::int16 : mavlink::MavParamType::real32,
                            .count = 100,
                            .index = index});
  }
  base::Task<> stream() {
    for (std::size_t i = 0; i < values.size(); ++i) {
      tell(i, static_cast<std::uint16_t>(i));
      co_await connection.loop().sleep(5ms);
    }
  }

  mavlink::Subscription subscription_;
  base::Scope scope_;
};

struct ParametersTest : ::testing::Test {
  ParametersTest() { world.run_for(2s); }
  auto all(std::string id = "1", bool old_ones_do = false) {
    return world.loop.run_until_done(parameters.all({std::move(id)}, old_ones_do));
  }
  auto change(std::string name, double value, std::string by = "anna") {
    return world.loop.run_until_done(parameters.change({"1"}, std::move(name), value, std::move(by)));
  }
  std::string commander() { return world.state().control.commander; }

  ControlWorld world;
  Copter copter{world.loop, world.hub.connect()};
  FleetParameters parameters{*world.fleet, parameters::Cache(), base::Logger(world.log, "fleet")};
};

TEST_F(ParametersTest, AskAVehicleForNothingUntilSomebodyAsks) {
  world.run_for(20s);
  EXPECT_EQ(copter.lists, 0);
  auto const list = all();
  ASSERT_TRUE(list) << list.error().message;
  EXPECT_EQ(list->parameters.size(), 100u);
  EXPECT_EQ(list->parameters[3].type, "int16");
  EXPECT_EQ(list->confirmed, vehicle::Confirmed::by_vehicle);
  EXPECT_EQ(copter.lists, 1);
}

TEST_F(ParametersTest, GiveOneListToEverybodyWhoAsksMeanwhile) {
  auto first = parameters.all({"1"}, false);
  auto second = parameters.file({"1"}, false);
  first.start();
  second.start();
  EXPECT_TRUE(world.run_until([&] { return parameters.progress({"1"})->done > 10; }));
  EXPECT_EQ(parameters.progress({"1"})->total, 100u);
  EXPECT_TRUE(world.run_until([&] { return first.done() && second.done(); }));
  EXPECT_FALSE(parameters.progress({"1"}));
  EXPECT_EQ(first.take()->parameters.size(), 100u);
  auto const file = second.take().value_or("");
  EXPECT_TRUE(file.starts_with(
      "# Onboard parameters for Vehicle 1\n#\n# Stack: ArduPilot\n# Vehicle: copter\n# Version: 4.6.0\n"))
      << file.substr(0, 200);
  EXPECT_EQ(copter.lists, 1);
}

TEST_F(ParametersTest, FetchOnWhenWhoAskedHasGone) {
  auto first = parameters.all({"1"}, false);
  first.start();
  world.run_for(200ms);
  first = {};
  EXPECT_TRUE(parameters.progress({"1"}));
  EXPECT_TRUE(world.run_until([&] { return !parameters.progress({"1"}); }));
}

TEST_F(ParametersTest, ServeWhatWasFetchedWhenThatWillDo) {
  ASSERT_TRUE(all());
  auto const old = all("1", true);
  ASSERT_TRUE(old);
  EXPECT_EQ(old->confirmed, vehicle::Confirmed::not_at_all);
  EXPECT_EQ(copter.lists, 1);
  ASSERT_TRUE(all());
  EXPECT_EQ(copter.lists, 2);
}

TEST_F(ParametersTest, FetchAnewForWhoWantsTheVehiclesOwnValues) {
  ASSERT_TRUE(all());
  world.way->begin();
  world.run_for(60s);
  world.way->end();
  world.run_for(2s);  // it has been away: who it is has to be asked before what is kept is given
  copter.values[5] = 99.0F;
  auto old = parameters.all({"1"}, true);
  auto own = parameters.all({"1"}, false);
  old.start();
  own.start();
  EXPECT_TRUE(world.run_until([&] { return old.done() && own.done(); }));
  auto const list = own.take();
  ASSERT_TRUE(list);
  EXPECT_EQ(list->confirmed, vehicle::Confirmed::by_vehicle);
  EXPECT_EQ(list->parameters[5].value, 99.0);
}

TEST_F(ParametersTest, SetOneAndGiveTheVehicleBack) {
  auto change = parameters.change({"1"}, "P1", 12.5, "anna");
  change.start();
  EXPECT_EQ(commander(), "anna");
  auto other = parameters.change({"1"}, "P2", 1.0, "anna");
  other.start();
  EXPECT_TRUE(world.run_until([&] { return change.done() && other.done(); }));
  auto const changed = change.take();
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(changed->before.value, 7.0);
  EXPECT_EQ(changed->after.value, 12.5);
  EXPECT_EQ(copter.values[1], 12.5F);
  EXPECT_EQ(commander(), "") << "nobody had it before";
  EXPECT_TRUE(world.has_logged("anna set P1 of copter 1 to 12.5 (was 7)"));
}

TEST_F(ParametersTest, LeaveTheVehicleToWhoCommandsItMeanwhile) {
  auto change = parameters.change({"1"}, "P1", 12.5, "anna");
  change.start();
  auto const hold = world.give({.action = vehicle::Action::hold}, {"1"}, "anna");
  EXPECT_TRUE(world.run_until([&] { return change.done(); }));
  EXPECT_FALSE(vehicle::is_over(world.outcome(hold).state));
  EXPECT_EQ(commander(), "anna");
}

TEST_F(ParametersTest, LeaveTheVehicleToWhoCommandsIt) {
  ASSERT_TRUE(world.control->request_control({"1"}, "anna"));
  EXPECT_TRUE(change("P1", 8.0));
  EXPECT_EQ(commander(), "anna");
  auto const refused = change("P1", 9.0, "ben");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(refused.error().message, "copter 1 is commanded by anna");
  EXPECT_EQ(copter.values[1], 8.0F);
  EXPECT_TRUE(world.loop.run_until_done(parameters.read({"1"}, "P1"))) << "who only looks needs no command";
}

TEST_F(ParametersTest, ChangeNothingWhileTheEmergencyStopIsLatched) {
  world.control->emergency_stop(vehicle::StopAction::hold, "ben");
  auto const refused = change("P1", 9.0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "emergency stop by ben: release it first");
}

TEST_F(ParametersTest, SayWhatTheVehicleStoredInstead) {
  auto const limited = change("P7", 80.0);
  ASSERT_FALSE(limited);
  EXPECT_EQ(limited.error().kind, base::ErrorKind::refused);
  EXPECT_EQ(limited.error().message, "vehicle 1 stored P7 = 50, not 80");
  auto const fraction = change("P3", 0.5);
  ASSERT_FALSE(fraction);
  EXPECT_EQ(fraction.error().kind, base::ErrorKind::invalid_input);
  EXPECT_FALSE(change("P1", std::nan("")));
  EXPECT_EQ(copter.values[1], 7.0F);
  EXPECT_EQ(commander(), "") << "a failure gives the vehicle back, too";
}

TEST_F(ParametersTest, FailWithAReason) {
  EXPECT_EQ(all("9").error().message, "there is no vehicle 9");
  EXPECT_EQ(world.loop.run_until_done(parameters.read({"1"}, "UNKNOWN")).error().kind, base::ErrorKind::timed_out);
  copter.is_silent = true;
  EXPECT_EQ(all().error().kind, base::ErrorKind::timed_out);
  EXPECT_FALSE(parameters.progress({"1"}));
  world.registry.edit({"1"}).links.connection = vehicle::Connection::lost;
  EXPECT_EQ(all().error().message, "copter 1 is not heard");
  EXPECT_EQ(change("P1", 9.0).error().kind, base::ErrorKind::lost);
}

}  // namespace
}  // namespace lapwing::fleet
