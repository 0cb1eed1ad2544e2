#include "fleet/mission/mission_run.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "fleet/testing/world.hpp"

// Every situation of the language specification's section 8.6, and what links and vehicles do beyond it.
namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using tasks::RunState;
using vehicle::VehicleId;

VehicleId const one{"1"};

struct MissionRun : ::testing::Test {
  std::unique_ptr<tasks::TaskRun> start(plan::Mission mission, VehicleId const& id = one) const {
    return world->platform->start(task_of(std::move(mission)), id);
  }
  /// The state in which the run ended, `in_progress` when it did not.
  RunState end_of(tasks::TaskRun const& run, base::Duration limit = 300s) const {
    (void)world->run_until([&run] { return run.state() != RunState::in_progress; }, limit);
    return run.state();
  }
  /// Why a mission fails whose copter says this in flight and returns home.
  std::string error_after(mavlink::MavSeverity severity, char const* text) const {
    auto& copter = world->add();
    world->run_for(5s);
    auto const run = start(mission_ending_with(MavCmd::nav_land));
    EXPECT_TRUE(world->comes_to(*run, "item 2/"));
    world->run_for(2s);
    copter.say(severity, text);
    copter.change_mode(copter_mode::rtl);
    EXPECT_EQ(end_of(*run, 3s), RunState::failed);
    return run->error();
  }

  std::unique_ptr<TestWorld> world = std::make_unique<TestWorld>();
};

TEST_F(MissionRun, FliesACopterFromTheGroundToTheGround) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
  EXPECT_EQ(copter.mission.size(), 6u);  // home and five items
  EXPECT_FALSE(copter.is_armed);
  EXPECT_EQ(copter.mode, copter_mode::automatic);
  auto const reports = world->platform->missions(one);
  ASSERT_EQ(reports.size(), 1u);
  EXPECT_EQ(reports[0].name, "survey");
  EXPECT_EQ(reports[0].items, 6);
  EXPECT_EQ(reports[0].outcome, "done");
  EXPECT_GT(reports[0].upload_s, 0.0);
  EXPECT_EQ(world->state().mission.planned_path.size(), 5u);
}

TEST_F(MissionRun, FliesARoverWithoutTouchingItsModeBeforehand) {
  auto& rover = world->add({.type = mavlink::MavType::ground_rover});
  world->run_for(5s);
  plan::Mission mission{.name = "patrol", .home = std::nullopt, .items = {}};
  for (int i = 1; i <= 3; ++i) mission.items.push_back(item_at(MavCmd::nav_waypoint, 50.0 * i));
  auto const run = start(std::move(mission));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
  EXPECT_EQ(rover.modes_commanded(), std::vector{rover_mode::automatic});
  EXPECT_EQ(rover.commands_heard(MavCmd::mission_start), 0);
}

TEST_F(MissionRun, ComparesTheFlightWithItsEstimate) {
  world->add();
  world->run_for(5s);
  auto const begun = world->loop.now();
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
  auto const flown = world->platform->missions(one).front().flown;
  ASSERT_TRUE(flown);
  EXPECT_GT(flown->estimate.duration, 0s);
  EXPECT_GT(flown->estimate.path_m, 0.0);
  EXPECT_GT(flown->path_m, 0.0);
  EXPECT_GT(flown->duration, 0s);
  EXPECT_LE(flown->duration, world->loop.now() - begun);
  EXPECT_TRUE(world->has_logged(plan::to_text(*flown)));
}

TEST_F(MissionRun, ComparesNothingWhenTheMissionNeverBegan) {
  world->add().refused_item = 3;
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::failed);
  EXPECT_FALSE(world->platform->missions(one).front().flown);
}

TEST_F(MissionRun, RefusesBeforeTheUploadWhatTheVehicleWouldSkip) {
  auto& rover = world->add({.type = mavlink::MavType::ground_rover});
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_waypoint));
  EXPECT_EQ(end_of(*run), RunState::failed);
  EXPECT_NE(run->error().find("item 1, NAV_TAKEOFF: a rover with ArduPilot would skip it"), std::string::npos)
      << run->error();
  EXPECT_TRUE(rover.mission.empty());
}

// Row 81.
TEST_F(MissionRun, AnswersMissionRequestInt) {
  world->add({.asks_with_request_int = true});
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

// Row 84.
TEST_F(MissionRun, NamesItemAndReasonWhenAnItemIsRefused) {
  auto& copter = world->add();
  copter.refused_item = 3;
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::failed);
  EXPECT_NE(run->error().find("item 3"), std::string::npos) << run->error();
  EXPECT_NE(run->error().find("support"), std::string::npos) << run->error();
  EXPECT_FALSE(run->vehicle_failed());
  world->run_for(30s);
  EXPECT_FALSE(copter.is_armed);
  EXPECT_NE(copter.mode, copter_mode::automatic);
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
}

// Row 85.
TEST_F(MissionRun, IsNotDoneBecauseTheVehicleWasInRtlBeforehand) {
  auto& copter = world->add({.request_spacing = 3s});
  copter.change_mode(copter_mode::rtl);
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_waypoint));
  EXPECT_EQ(end_of(*run, 15s), RunState::in_progress);
  EXPECT_NE(run->progress().find("uploading"), std::string::npos) << run->progress();
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
  EXPECT_TRUE(copter.is_flying);  // it flew, and holds at the last place
}

// Row 87.
TEST_F(MissionRun, IsDoneWhenItLandedAndDisarmedAndStaysInAuto) {
  auto& copter = world->add();
  copter.reports_complete = false;
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
  EXPECT_EQ(copter.mode, copter_mode::automatic);
}

// Row 88.
TEST_F(MissionRun, FailsAsLostWhenTheVehicleFallsSilentInFlight) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_loiter_unlim));
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  copter.is_silent = true;
  EXPECT_EQ(end_of(*run, 19s), RunState::in_progress);
  EXPECT_EQ(end_of(*run, 5s), RunState::failed);
  EXPECT_EQ(run->error(), "copter 1 lost: silent for 20 s");
  EXPECT_TRUE(run->vehicle_failed());
}

TEST_F(MissionRun, SurvivesASilenceShorterThanTheTimeout) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land, 8));
  ASSERT_TRUE(world->comes_to(*run, "item 3/"));
  copter.is_silent = true;
  world->run_for(12s);
  copter.is_silent = false;
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

// What it last told of its place was in the air; it has landed since.
TEST_F(MissionRun, JudgesAVehicleThatIsBackByWhatItTellsThen) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const lost = start(mission_ending_with(MavCmd::nav_land));
  ASSERT_TRUE(world->comes_to(*lost, "item 2/"));
  copter.is_silent = true;
  ASSERT_EQ(end_of(*lost), RunState::failed);
  ASSERT_TRUE(world->run_until([&] { return !copter.is_armed; }));
  copter.stream(mavlink::MessageId::global_position_int, 5s);
  world->run_for(1s);
  copter.is_silent = false;
  ASSERT_TRUE(world->run_until([&] { return world->state().links.connection == vehicle::Connection::ok; }, 3s));
  ASSERT_GT(world->state().motion.position.value->alt_m, TestAutopilot::home.alt_m + 10.0) << "its place came first";
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

// Row 89, as far as it is the platform's: the language compares with what it finds here.
TEST_F(MissionRun, KnowsNoBatteryThatTheVehicleDoesNotReport) {
  auto& copter = world->add();
  copter.battery.reset();
  world->run_for(10s);
  EXPECT_FALSE(world->platform->find(one)->battery.has_value());
  EXPECT_FALSE(world->platform->find(one)->battery_is_awaited);
}

TEST_F(MissionRun, AwaitsTheBatteryUntilTheFirstReport) {
  world->add();
  ASSERT_TRUE(world->run_until([&] { return world->platform->find(one).has_value(); }, 2s));
  EXPECT_TRUE(world->platform->find(one)->battery_is_awaited);
  world->run_for(5s);
  EXPECT_FALSE(world->platform->find(one)->battery_is_awaited);
  EXPECT_EQ(world->platform->find(one)->mode, "STABILIZE");
  EXPECT_EQ(world->platform->find(one)->relative_alt_m, 0.0);
}

// Row 91.
TEST_F(MissionRun, KnowsACopterAsUavAndItsAutoAsMode3) {
  auto& copter = world->add();
  world->run_for(5s);
  EXPECT_EQ(world->platform->find(one)->type, "UAV");
  auto const run = start(mission_ending_with(MavCmd::nav_loiter_unlim));
  ASSERT_TRUE(world->comes_to(*run, "item 2/"));
  EXPECT_EQ(copter.mode, 3u);
}

// Row 93.
TEST_F(MissionRun, GivesTheVehiclesReasonWhenArmingIsRefused) {
  auto& copter = world->add();
  copter.arming_refusal = "Arm: Throttle too high";
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::failed);
  EXPECT_EQ(run->error(), "arming refused: Arm: Throttle too high");
  world->run_for(30s);
  EXPECT_EQ(copter.mode, copter_mode::stabilize);
  EXPECT_TRUE(copter.modes_commanded().empty());
  EXPECT_EQ(copter.commands_heard(MavCmd::mission_start), 0);
}

// Row 95.
TEST_F(MissionRun, LeavesTheVehicleToThePilotWhoChangesItsMode) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  ASSERT_TRUE(world->comes_to(*run, "item 2/"));
  world->run_for(2s);
  auto const heard = copter.heard.size();
  copter.change_mode(copter_mode::stabilize);
  EXPECT_EQ(end_of(*run, 3s), RunState::failed);
  EXPECT_EQ(run->error(), "mode changed to STABILIZE by operator");
  world->run_for(60s);
  EXPECT_EQ(copter.heard.size(), heard);
}

TEST_F(MissionRun, NamesTheFailsafeThatTookTheVehicleOver) {
  EXPECT_EQ(error_after(mavlink::MavSeverity::critical, "Battery Failsafe"),
            "mode changed to RTL by the vehicle: Battery Failsafe");
}

TEST_F(MissionRun, NamesTheFenceThatEndedItInTheWordsOfArduPilot47) {
  EXPECT_EQ(error_after(mavlink::MavSeverity::notice, "Circle fence breached"),
            "mode changed to RTL by the vehicle: Circle fence breached");
}

TEST_F(MissionRun, IsDoneWhenTheAutopilotReturnsByItselfAfterTheLastItem) {
  auto& copter = world->add();
  copter.ends_in_rtl = true;
  copter.reports_complete = false;
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_waypoint));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

TEST_F(MissionRun, NeverEndsAnUnlimitedLoiter) {
  world->add();
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_loiter_unlim));
  EXPECT_EQ(end_of(*run, 20min), RunState::in_progress) << run->error();
}

TEST_F(MissionRun, WaitsForTheEstimatorAfterAColdStart) {
  auto& copter = world->add({.position_ok_after = 42s});
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  world->run_for(30s);
  EXPECT_EQ(run->progress(), "waiting until the vehicle is ready");
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

TEST_F(MissionRun, SaysWhatIsMissingWhenTheVehicleDoesNotGetReady) {
  auto& copter = world->add({.position_ok_after = 1h});
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::failed);
  EXPECT_EQ(run->error(), "not ready after 90 s, no GPS fix");
  EXPECT_TRUE(copter.mission.empty());
}

TEST_F(MissionRun, TakesAVehicleOutOfAutoBeforeTheUpload) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const first = start(mission_ending_with(MavCmd::nav_loiter_unlim));
  ASSERT_TRUE(world->comes_to(*first, "item 3/"));
  auto const second = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(first->state(), RunState::failed);
  EXPECT_EQ(first->error(), "another task took the vehicle");
  ASSERT_TRUE(world->comes_to(*second, "uploading"));
  EXPECT_EQ(copter.mode, copter_mode::brake);
  EXPECT_EQ(end_of(*second), RunState::done) << second->error();
}

TEST_F(MissionRun, FliesAgainAfterALandingThatLeftTheCopterInAuto) {
  auto& copter = world->add();
  world->run_for(5s);
  for (int round = 0; round < 3; ++round) {
    auto const run = start(mission_ending_with(MavCmd::nav_land));
    ASSERT_EQ(end_of(*run), RunState::done) << round << ": " << run->error();
    EXPECT_EQ(copter.mode, copter_mode::automatic);
  }
  EXPECT_EQ(world->platform->missions(one).size(), 3u);
}

TEST_F(MissionRun, RefusesToStartWhatTheVehicleDoesNotHold) {
  auto& copter = world->add();
  copter.forgets_items = true;
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::failed);
  EXPECT_NE(run->error().find("does not hold what was sent: item 1"), std::string::npos) << run->error();
  EXPECT_EQ(copter.commands_heard(MavCmd::component_arm_disarm), 0);
}

TEST_F(MissionRun, FailsWithAReasonWhenTheVehicleFallsSilentInTheUpload) {
  auto& copter = world->add();
  copter.silent_from_item = 2;
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run, 60s), RunState::failed);
  EXPECT_FALSE(run->error().empty());
  copter.is_silent = false;
  world->run_for(60s);
  EXPECT_FALSE(copter.is_armed);
  EXPECT_EQ(copter.commands_heard(MavCmd::mission_start), 0);
}

TEST_F(MissionRun, FailsWhenTheVehicleRestartsInFlight) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  ASSERT_TRUE(world->comes_to(*run, "item 2/"));
  copter.reboot(world->hub.connect());
  EXPECT_EQ(end_of(*run, 10s), RunState::failed);
  EXPECT_EQ(run->error(), "copter 1 restarted");
  EXPECT_TRUE(run->vehicle_failed());
  world->run_for(30s);
  EXPECT_NE(copter.mode, copter_mode::automatic);
}

TEST_F(MissionRun, SendsNothingWhileItMayBeTwoVehicles) {
  auto& copter = world->add();
  world->run_for(5s);
  auto& twin = world->add();
  ASSERT_TRUE(world->run_until([&] { return world->connection.is_contested(1); }, 2s));
  auto const heard = copter.heard.size() + twin.heard.size();
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run, 10s), RunState::failed);
  EXPECT_NE(run->error().find("two vehicles use system id 1"), std::string::npos) << run->error();
  EXPECT_TRUE(run->vehicle_failed());
  EXPECT_EQ(copter.heard.size() + twin.heard.size(), heard);
}

TEST_F(MissionRun, TakesASecondVehicleThatAppearsInFlightForNoRestart) {
  auto& copter = world->add();
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land, 8));
  ASSERT_TRUE(world->comes_to(*run, "item 2/"));
  auto& twin = world->add();
  EXPECT_EQ(end_of(*run, 10s), RunState::failed);
  EXPECT_NE(run->error().find("two vehicles use system id 1"), std::string::npos) << run->error();
  EXPECT_EQ(copter.mode, copter_mode::automatic);
  EXPECT_EQ(twin.commands_heard(MavCmd::component_arm_disarm), 0);
}

TEST_F(MissionRun, FliesAVehicleThatRestartedJustBefore) {
  auto& copter = world->add();
  world->run_for(5s);
  copter.reboot(world->hub.connect());
  ASSERT_TRUE(world->run_until([&] { return world->connection.is_contested(1); }, 2s));
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

TEST_F(MissionRun, UsesTheModeWhenMissionStartIsRefused) {
  auto& copter = world->add();
  copter.refused_commands.insert(MavCmd::mission_start);
  copter.is_flying = true;
  copter.is_armed = true;
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

TEST_F(MissionRun, DisarmsAgainWhenTheStartFailsAfterArming) {
  auto& copter = world->add();
  copter.refused_commands = {MavCmd::mission_start, MavCmd::do_set_mode};
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::failed);
  EXPECT_NE(run->error().find("AUTO not entered"), std::string::npos) << run->error();
  world->loop.run_until_done(world->platform->settle());
  world->run_for(15s);
  EXPECT_FALSE(copter.is_armed);
  EXPECT_NE(copter.mode, copter_mode::automatic);
}

TEST_F(MissionRun, SelectsTheFirstItemByMessageWhereTheCommandIsUnknown) {
  auto& copter = world->add();
  copter.refused_commands.insert(MavCmd::do_set_mission_current);
  copter.takes_set_current_message = true;
  world->run_for(5s);
  auto const run = start(mission_ending_with(MavCmd::nav_land));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
}

TEST_F(MissionRun, SetsTheScriptsHome) {
  auto& copter = world->add();
  world->run_for(5s);
  auto mission = mission_ending_with(MavCmd::nav_land);
  mission.home = TestAutopilot::home;
  auto const run = start(std::move(mission));
  EXPECT_EQ(end_of(*run), RunState::done) << run->error();
  auto const is_set_home = [](mavlink::Message const& message) {
    auto const* command = std::get_if<mavlink::CommandInt>(&message);
    return command && command->command == MavCmd::do_set_home;
  };
  EXPECT_EQ(std::ranges::count_if(copter.heard, is_set_home), 1);
}

TEST_F(MissionRun, FailsForAnUnknownVehicleAndForAnEmptyMission) {
  world->add();
  world->run_for(5s);
  auto const nowhere = start(mission_ending_with(MavCmd::nav_land), VehicleId{"9"});
  EXPECT_EQ(nowhere->state(), RunState::failed);
  EXPECT_EQ(nowhere->error(), "no vehicle 9");
  auto const nothing = start(plan::Mission{.name = "empty", .home = std::nullopt, .items = {}});
  EXPECT_EQ(nothing->state(), RunState::failed);
  EXPECT_EQ(nothing->error(), "the mission has no items");
}

TEST_F(MissionRun, FliesTwoVehiclesAtOnce) {
  world->add();
  world->add({.address = {2, 1}});
  world->run_for(5s);
  auto const first = start(mission_ending_with(MavCmd::nav_land));
  auto const second = start(mission_ending_with(MavCmd::nav_land, 6), VehicleId{"2"});
  EXPECT_EQ(end_of(*first), RunState::done) << first->error();
  EXPECT_EQ(second->state(), RunState::in_progress);
  EXPECT_EQ(end_of(*second), RunState::done) << second->error();
}

// Row 82 and the lossy link: whatever is lost is repeated.
class LossyLink : public MissionRun, public testing::WithParamInterface<std::uint64_t> {};

TEST_P(LossyLink, CompletesWithThirtyPercentLossAndTwoHundredMillisecondsDelay) {
  auto& copter = world->add({}, {.loss = 0.3, .delay = 200ms, .seed = GetParam()});
  world->run_for(10s);
  auto const run = start(mission_ending_with(MavCmd::nav_land, 8));
  EXPECT_EQ(end_of(*run, 15min), RunState::done) << run->error();
  EXPECT_FALSE(copter.is_armed);
  EXPECT_EQ(copter.mission.size(), 11u);
}

INSTANTIATE_TEST_SUITE_P(Seeds, LossyLink, testing::Range<std::uint64_t>(1, 41));

TEST_F(MissionRun, CompletesOnALinkThatDuplicatesAndReorders) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    world = std::make_unique<TestWorld>();
    world->add({}, {.loss = 0.1, .duplication = 0.3, .delay = 50ms, .jitter = 300ms, .seed = seed});
    world->run_for(10s);
    auto const run = start(mission_ending_with(MavCmd::nav_land, 8));
    EXPECT_EQ(end_of(*run, 15min), RunState::done) << seed << ": " << run->error();
  }
}

}  // namespace
}  // namespace lapwing::fleet
