#include "fleet/network/fleet.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fleet/testing/world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavType;
using mavlink::MessageId;
using vehicle::Connection;
using vehicle::VehicleId;

mavlink::Heartbeat heartbeat(MavType type, mavlink::MavAutopilot autopilot, std::uint32_t mode = 0) {
  return {.type = type, .autopilot = autopilot, .custom_mode = mode};
}

TEST(Fleet, MakesAVehicleOfAnAutopilotsHeartbeat) {
  TestWorld world;
  auto& copter = world.add();
  copter.change_mode(copter_mode::guided);
  world.run_for(3s);
  ASSERT_EQ(world.registry.all().size(), 1u);
  auto const& state = world.state();
  EXPECT_EQ(state.name, "copter 1");
  EXPECT_EQ(state.system_id, 1);
  EXPECT_EQ(state.family, vehicle::Family::copter);
  EXPECT_EQ(state.autopilot, vehicle::Autopilot::ardupilot);
  EXPECT_EQ(state.links.connection, Connection::ok);
  EXPECT_EQ(state.mode.value, "GUIDED");
  EXPECT_EQ(state.arming.armed.value, false);
  EXPECT_FALSE(state.links.used.empty());
}

TEST(Fleet, MapsVehicleTypesToTheWordsOfTheLanguage) {
  TestWorld world;
  std::vector<std::pair<MavType, std::string>> const kinds{
      {MavType::quadrotor, "UAV"}, {MavType::fixed_wing, "UAV"},   {MavType::vtol_tiltrotor, "UAV"},
      {MavType::airship, "UAV"},   {MavType::ground_rover, "UGV"}, {MavType::surface_boat, "USV"},
      {MavType::submarine, "UUV"}};
  std::uint8_t system_id = 1;
  for (auto const& [type, word] : kinds) world.add({.address = {system_id++, 1}, .type = type});
  world.run_for(2s);
  auto const vehicles = world.platform->vehicles();
  ASSERT_EQ(vehicles.size(), kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) EXPECT_EQ(vehicles[i].type, kinds[i].second) << i;
}

TEST(Fleet, MakesNoVehicleOfGroundStationsAndComponents) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(1s);
  copter.send_as({252, 190}, heartbeat(MavType::gcs, mavlink::MavAutopilot::invalid));
  copter.send_as({7, 1}, heartbeat(MavType::gcs, mavlink::MavAutopilot::invalid));
  copter.send_as({8, 1}, heartbeat(MavType::antenna_tracker, mavlink::MavAutopilot::ardupilotmega));
  copter.send_as({9, 1}, heartbeat(MavType::adsb, mavlink::MavAutopilot::invalid));
  copter.send_as({10, 191}, heartbeat(MavType::onboard_controller, mavlink::MavAutopilot::invalid));
  copter.send_as({11, 154}, heartbeat(MavType::gimbal, mavlink::MavAutopilot::invalid));
  world.run_for(2s);
  EXPECT_EQ(world.registry.all().size(), 1u);
}

// Language specification, row 92.
TEST(Fleet, KeepsTheModeWhenAGimbalOfTheSameSystemSendsAHeartbeat) {
  TestWorld world;
  auto& copter = world.add();
  copter.change_mode(copter_mode::guided);
  world.run_for(1s);
  copter.send_as({1, 154}, heartbeat(MavType::gimbal, mavlink::MavAutopilot::invalid));
  world.run_for(100ms);
  EXPECT_EQ(world.state().mode.value, "GUIDED");
  EXPECT_EQ(world.state().name, "copter 1");
}

TEST(Fleet, AddsTheCameraThatItHearsToTheConfiguredPayload) {
  TestWorld world({.payload = {{{.system_id = 1}, {"Lidar"}}}});
  auto& copter = world.add();
  world.run_for(1s);
  EXPECT_EQ(world.state().payload.names, std::vector<std::string>{"Lidar"});
  copter.send_as({1, 100}, heartbeat(MavType::camera, mavlink::MavAutopilot::invalid));
  copter.send_as({1, 100}, heartbeat(MavType::camera, mavlink::MavAutopilot::invalid));
  world.run_for(1s);
  EXPECT_EQ(world.state().payload.names, (std::vector<std::string>{"Lidar", "Camera"}));
}

TEST(Fleet, LosesASilentVehicleAfterItsTimeoutAndTakesItBack) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(2s);
  copter.is_silent = true;
  world.run_for(18s);
  EXPECT_EQ(world.state().links.connection, Connection::ok);
  world.run_for(4s);
  EXPECT_EQ(world.state().links.connection, Connection::lost);
  EXPECT_FALSE(world.platform->find(VehicleId{"1"})->connected);
  EXPECT_TRUE(world.has_logged("copter 1 lost: silent for 20 s"));
  copter.is_silent = false;
  world.run_for(2s);
  EXPECT_EQ(world.state().links.connection, Connection::ok);
  EXPECT_TRUE(world.has_logged("copter 1 is back"));
}

TEST(Fleet, TimesOutEachVehicleByItsOwnSetting) {
  TestWorld world;
  auto& first = world.add();
  auto& second = world.add({.address = {2, 1}});
  world.run_for(2s);
  world.platform->set_connection_timeout(VehicleId{"2"}, 60s);
  first.is_silent = second.is_silent = true;
  world.run_for(30s);
  EXPECT_EQ(world.state("1").links.connection, Connection::lost);
  EXPECT_EQ(world.state("2").links.connection, Connection::ok);
}

TEST(Fleet, TellsOfArrivalsAndLossesAtOnce) {
  TestWorld world;
  auto const arrival = [](TestWorld& w) -> base::Task<bool> {
    co_return co_await w.platform->vehicles_changed().wait_until(w.loop.now() + 5s);
  };
  world.add();
  EXPECT_TRUE(world.loop.run_until_done(arrival(world)));
  EXPECT_LT(world.loop.now(), base::TimePoint(2s));
}

TEST(Fleet, NamesBothPeersWhenTwoVehiclesUseOneSystemId) {
  TestWorld world;
  auto& first = world.add();
  auto& second = world.add();
  world.run_for(10s);
  EXPECT_EQ(world.state().links.connection, Connection::conflict);
  EXPECT_FALSE(world.platform->find(VehicleId{"1"})->connected);
  EXPECT_TRUE(world.has_logged("two vehicles use system id 1: "));
  auto const first_commands = first.heard.size();
  auto const second_commands = second.heard.size();
  auto const run = world.platform->start(task_of(mission_ending_with(mavlink::MavCmd::nav_land)), VehicleId{"1"});
  world.run_for(5s);
  EXPECT_EQ(run->state(), tasks::RunState::failed);
  EXPECT_NE(run->error().find("two vehicles use system id 1"), std::string::npos) << run->error();
  EXPECT_EQ(first.heard.size(), first_commands);
  EXPECT_EQ(second.heard.size(), second_commands);
}

TEST(Fleet, EndsTheConflictWhenOneOfTheTwoLeaves) {
  TestWorld world;
  auto& first = world.add();
  world.add();
  world.run_for(10s);
  EXPECT_EQ(world.state().links.connection, Connection::conflict);
  first.is_silent = true;
  world.run_for(10s);
  EXPECT_EQ(world.state().links.connection, Connection::ok);
}

// The last place may be the other one's.
TEST(Fleet, TakesNothingToldInAConflictAsCurrent) {
  TestWorld world;
  auto& first = world.add();
  world.run_for(5s);
  world.add();
  world.run_for(10s);
  ASSERT_EQ(world.state().links.connection, Connection::conflict);
  auto const& craft = *world.fleet->find(VehicleId{"1"});
  first.is_silent = true;
  ASSERT_TRUE(world.run_until([&] { return craft.is_connected(); }, 10s));
  ASSERT_TRUE(craft.state.motion.position.known());
  EXPECT_FALSE(craft.is_current(craft.state.motion.position));
  world.run_for(5s);
  EXPECT_TRUE(craft.is_current(craft.state.motion.position));
}

TEST(Fleet, TakesNothingToldBeforeARestartAsCurrent) {
  TestWorld world;
  auto& copter = world.add();
  copter.change_mode(copter_mode::guided);
  world.run_for(20s);
  auto const& craft = *world.fleet->find(VehicleId{"1"});
  ASSERT_TRUE(craft.is_current(craft.state.motion.landed));
  copter.reboot(world.hub.connect());
  ASSERT_TRUE(world.run_until([&] { return craft.heard->boots == 2; }, 10s));
  EXPECT_FALSE(craft.is_current(craft.state.motion.landed));
  world.run_for(10s);
  EXPECT_TRUE(craft.is_current(craft.state.motion.landed));
}

TEST(Fleet, AsksOnlyForMessagesThatDoNotComeByThemselves) {
  TestWorld world;
  auto& copter = world.add();
  copter.stream(MessageId::attitude, 100ms);
  copter.stream(MessageId::sys_status, 500ms);
  world.run_for(10s);
  auto const asked = copter.messages_asked_for();
  EXPECT_EQ(std::ranges::count(asked, MessageId::attitude), 0);
  EXPECT_EQ(std::ranges::count(asked, MessageId::sys_status), 0);
  EXPECT_EQ(std::ranges::count(asked, MessageId::global_position_int), 1);
  EXPECT_EQ(std::ranges::count(asked, MessageId::ekf_status_report), 1);
  EXPECT_TRUE(world.state().motion.position.known());
  EXPECT_LT(*world.state().motion.position.age(world.loop.now()), 500ms);
}

TEST(Fleet, KnowsAtOnceWhereANewVehicleIs) {
  TestWorld world;
  world.add({.tells_place = true});
  ASSERT_TRUE(world.run_until([&] { return !world.registry.all().empty(); }));
  auto const found = world.loop.now();
  EXPECT_TRUE(world.run_until([&] { return world.state().motion.position.known(); }));
  EXPECT_LT(world.loop.now() - found, 1s);
}

TEST(Fleet, AsksForNothingWhenToldOnlyToListen) {
  TestWorld world({.asks_for_messages = false});
  auto& copter = world.add();
  world.run_for(30s);
  EXPECT_TRUE(copter.heard.empty());
}

TEST(Fleet, StopsAskingForWhatIsDenied) {
  TestWorld world;
  auto& copter = world.add();
  copter.denied_intervals.insert(MessageId::extended_sys_state);
  world.run_for(60s);
  EXPECT_EQ(std::ranges::count(copter.messages_asked_for(), MessageId::extended_sys_state), 1);
}

TEST(Fleet, AsksAgainAfterARestartAndNoticesIt) {
  TestWorld world;
  auto& copter = world.add();
  copter.change_mode(copter_mode::guided);
  world.run_for(20s);
  auto const asked = std::ranges::count(copter.messages_asked_for(), MessageId::attitude);
  copter.reboot(world.hub.connect());
  world.run_for(10s);
  EXPECT_EQ(world.fleet->find(VehicleId{"1"})->heard->boots, 2);
  EXPECT_TRUE(world.has_logged("copter 1 restarted"));
  EXPECT_GT(std::ranges::count(copter.messages_asked_for(), MessageId::attitude), asked);
  EXPECT_LT(*world.state().motion.position.age(world.loop.now()), 500ms);
  EXPECT_EQ(world.state().links.connection, Connection::ok);
}

TEST(Fleet, NoticesARestartByTheVehiclesClockWhenItsModeDidNotChange) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(20s);
  copter.reboot(world.hub.connect());
  world.run_for(10s);
  EXPECT_EQ(world.fleet->find(VehicleId{"1"})->heard->boots, 2);
}

TEST(Fleet, DoesNotTakeAMoveToAnotherAddressForARestart) {
  TestWorld world;
  auto& copter = world.add();
  copter.stream(MessageId::attitude, 200ms);
  world.run_for(20s);
  // The same vehicle goes on speaking, from another port.
  TestAutopilot moved(world.loop, world.hub.connect(), {});
  copter.is_silent = true;
  moved.change_mode(copter.mode);
  world.run_for(1s);
  EXPECT_EQ(world.fleet->find(VehicleId{"1"})->heard->boots, 1);
}

TEST(Fleet, ShowsWhatARadioSaysAtTheVehiclesBehindIt) {
  TestWorld world;
  auto& near = world.add();
  world.add({.address = {2, 1}});
  world.run_for(1s);
  near.send_as({51, 68}, mavlink::RadioStatus{.rssi = 180, .remote_rssi = 170, .transmit_buffer_free = 0.9});
  world.run_for(100ms);
  ASSERT_TRUE(world.state("1").links.radio.known());
  EXPECT_EQ(world.state("1").links.radio.value->rssi, 180);
  EXPECT_FALSE(world.state("2").links.radio.known());
  EXPECT_EQ(world.registry.all().size(), 2u);
}

TEST(Fleet, ShowsTextsOfComponentsAndTornOnes) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(1s);
  copter.send_as({1, 100}, mavlink::StatusText{.text = "card full"});
  copter.send(mavlink::StatusText{.text = std::string(50, 'x'), .id = 3});
  world.run_for(1s);
  ASSERT_EQ(world.state().recent_texts.size(), 1u);
  EXPECT_EQ(world.state().recent_texts[0].component, 100);
  world.run_for(3s);  // nothing else is said
  ASSERT_EQ(world.state().recent_texts.size(), 2u);
  EXPECT_EQ(world.state().recent_texts[1].text, std::string(50, 'x') + "...");
}

TEST(Fleet, ForgetsReasonsAgainstArmingThatAreNotRepeated) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(1s);
  copter.say(mavlink::MavSeverity::critical, "Arm: Throttle too high");
  world.run_for(60s);
  EXPECT_EQ(world.state().arming.reasons.size(), 1u);
  world.run_for(20s);
  EXPECT_TRUE(world.state().arming.reasons.empty());
}

TEST(Fleet, GivesTheRatesBackThatItChanged) {
  TestWorld world;
  auto& copter = world.add();
  copter.stream(MessageId::attitude, 2s);  // too slow for us
  copter.stream(MessageId::sys_status, 500ms);
  world.run_for(10s);
  ASSERT_EQ(copter.interval(MessageId::attitude), 250ms);
  ASSERT_EQ(copter.interval(MessageId::global_position_int), 200ms);
  world.loop.run_until_done(world.fleet->give_back_rates());
  EXPECT_EQ(copter.interval(MessageId::attitude), 2s);
  EXPECT_EQ(copter.interval(MessageId::global_position_int), std::nullopt);
  EXPECT_EQ(copter.interval(MessageId::sys_status), 500ms);
  world.run_for(30s);  // and asks for nothing any more
  EXPECT_EQ(copter.interval(MessageId::global_position_int), std::nullopt);
}

TEST(Fleet, LeavesRatesThatSomebodyElseSetMeanwhile) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(10s);
  copter.stream(MessageId::attitude, 100ms);
  world.loop.run_until_done(world.fleet->give_back_rates());
  EXPECT_EQ(copter.interval(MessageId::attitude), 100ms);
}

TEST(Fleet, LeavesItsRatesToAnotherGroundStationOnTheLink) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(10s);
  copter.send_as({252, 190}, heartbeat(MavType::gcs, mavlink::MavAutopilot::invalid));
  world.run_for(1s);
  world.loop.run_until_done(world.fleet->give_back_rates());
  EXPECT_EQ(copter.interval(MessageId::attitude), 250ms);
}

TEST(Fleet, GivesBackWithinThreeSecondsThoughNobodyAnswers) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(10s);
  copter.is_silent = true;
  auto const begun = world.loop.now();
  world.loop.run_until_done(world.fleet->give_back_rates());
  EXPECT_LE(world.loop.now() - begun, 3100ms);
}

TEST(Fleet, NeverLowersARateThatTheLinkLoses) {
  TestWorld world;
  auto& copter = world.add({}, {.loss = 0.7});
  copter.stream(MessageId::attitude, 150ms);
  world.run_for(30s);
  EXPECT_EQ(copter.interval(MessageId::attitude), 150ms);
}

TEST(Fleet, KeepsAFewOfTheQuestionsToAVehicleThatCannotBeAsked) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(2s);
  copter.is_silent = true;
  world.run_for(30s);
  auto& craft = *world.fleet->find(vehicle::VehicleId{"1"});
  for (int picture = 0; picture < 1000; ++picture)
    ask(craft, {MessageId::camera_image_captured, 100, static_cast<float>(picture)});
  EXPECT_EQ(craft.asked->questions.size(), 200u);
  EXPECT_EQ(craft.asked->questions.front().argument, 800.0F) << "the latest";
}

TEST(Fleet, LeavesItsConnectionsToOthersWhenItEnds) {
  TestWorld world;
  world.add();
  world.run_for(2s);
  world.platform.reset();
  world.fleet.reset();
  EXPECT_TRUE(world.connection.send({1, 1}, mavlink::ParamRequestList{}));
}

}  // namespace
}  // namespace lapwing::fleet
