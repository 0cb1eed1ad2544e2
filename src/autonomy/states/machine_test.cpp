#include "autonomy/states/machine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

bool asks_for(Said const& said, std::string_view mode) {
  auto const modes = requests<request::Mode>(said);
  return modes.size() == 1 && modes.front().mode == mode;
}

// ---- on the ground

TEST(Machine, BeginsIdleAndSaysWhetherTheOperatorIsHeard) {
  Bench bench;
  EXPECT_EQ(bench.step().state, State::idle);
  EXPECT_EQ(bench.said.health, Health{});
  bench.told.link = {.is_up = false, .silence = 4s};
  EXPECT_EQ(bench.step().health, (Health{false, "CommunicationLost"}));
}

TEST(Machine, SendsAHeartbeatTwiceASecondAndWhenTheStateChanges) {
  Bench bench;
  bench.step();
  auto const sent = [&](auto const& all) { return std::ranges::count_if(all, &Said::sends_heartbeat); };
  EXPECT_EQ(sent(bench.run_for(10s)), 20);
  bench.give(command::Arm{});
  EXPECT_TRUE(bench.said.sends_heartbeat);
  EXPECT_FALSE(bench.step().sends_heartbeat);
  auto lost = bench_in(State::communication_lost);
  EXPECT_EQ(sent(lost.run_for(10s)), 0);
}

TEST(Machine, TakesAndSavesHeights) {
  Bench bench;
  bench.give(command::Configure{{8, 12, 16}});
  EXPECT_EQ(bench.said.state, State::configure);
  EXPECT_EQ(bench.said.to_save, (HoverHeights{8, 12, 16}));
  EXPECT_EQ(bench.step().state, State::idle);
  EXPECT_EQ(bench.said.to_save, std::nullopt);
  EXPECT_EQ(bench.machine.memory().heights, (HoverHeights{8, 12, 16}));
}

TEST(Machine, SavesNothingOfWrongHeights) {
  Bench bench;
  bench.give(command::Configure{{8, 8, 16}});
  EXPECT_EQ(bench.said.to_save, std::nullopt);
  EXPECT_EQ(bench.said.user_error, UserError::height_params_invalid);
  EXPECT_TRUE(tells(bench.said, "the heights are not taken: the lowest hover height (8 m) is not below"));
  EXPECT_EQ(bench.machine.memory().heights, HoverHeights{});
  EXPECT_EQ(bench.step().user_error, UserError::height_params_invalid);
  bench.give(command::Configure{{8, 9, 16}});
  EXPECT_EQ(bench.said.user_error, UserError::none);
}

struct Hindrance {
  std::string_view words;
  void (*make)(Bench&);
};

TEST(Machine, DoesNotArmWhatIsNotReadyAndSaysWhy) {
  for (auto const& [words, make] : std::initializer_list<Hindrance>{
           {"the battery has 20 %, and more than 20 % are needed", [](Bench& b) { b.flight().battery = 0.2; }},
           {"the battery's charge is not known", [](Bench& b) { b.flight().battery.reset(); }},
           {"the battery's charge is not known",
            [](Bench& b) { b.flight().battery = std::numeric_limits<double>::quiet_NaN(); }},
           {"the battery's charge is not known", [](Bench& b) { b.told.flight.reset(); }},
           {"mapper has not reported yet", [](Bench& b) { b.told.processes[1].silence.reset(); }},
           {"vision has failed: no camera",
            [](Bench& b) { b.told.processes[0] = {"vision", 100ms, false, "no camera"}; }},
           {"the flight controller's own checks fail", [](Bench& b) { b.flight().prearm_ok = false; }},
           {"there is no GPS fix (type 2)", [](Bench& b) { b.flight().gps_fix = 2; }},
           {"it is flying already", [](Bench& b) { b.fly_at(9); }},
           {"it is landing: wait until it is disarmed", [](Bench& b) {
              b.fly_at(0.95);
              b.flight().mode = "RTL";
            }}}) {
    Bench bench;
    bench.step();
    make(bench);
    bench.give(command::Arm{});
    EXPECT_EQ(bench.said.state, State::idle) << words;
    EXPECT_TRUE(tells(bench.said, "Arm is refused: " + std::string(words))) << words;
  }
}

TEST(Machine, ArmsStepByStepAsTheFlightControllerFollows) {
  Bench bench;
  bench.flight().home.reset();
  bench.flight().position.reset();
  bench.give(command::Arm{});
  EXPECT_TRUE(bench.step().requests.empty()) << "home is not known";
  bench.flight().position = home_place;
  EXPECT_TRUE(asks_for(bench.step(), "GUIDED"));
  EXPECT_EQ(bench.machine.memory().home, home_place);
  EXPECT_TRUE(requests<request::Arm>(bench.run_for(500ms)).empty());
  bench.flight().mode = guided;
  auto const arms = requests<request::Arm>(bench.step());
  ASSERT_EQ(arms.size(), 1u);
  EXPECT_TRUE(arms.front().is_to_arm);
  bench.flight().is_armed = true;
  EXPECT_TRUE(bench.step().requests.empty());
  EXPECT_EQ(bench.give(command::Takeoff{}).state, State::takeoff);
}

TEST(Machine, WaitsForASilentFlightControllerAndGivesUp) {
  Bench bench;
  bench.flight().silence = 5s;
  bench.give(command::Arm{});
  EXPECT_EQ(bench.said.state, State::arm);
  bench.run_for(19s);
  EXPECT_EQ(bench.state(), State::arm);
  bench.run_for(2s);
  EXPECT_EQ(bench.state(), State::idle);
}

TEST(Machine, SaysWhatIsMissingWhenItGivesUpArming) {
  Bench bench;
  bench.give(command::Arm{});
  for (auto const& said : bench.run_for(21s))
    if (said.state == State::idle && !said.error_log.empty()) {
      EXPECT_TRUE(tells(said, "arming was given up: the flight controller did not take mode GUIDED"));
    }
  EXPECT_EQ(bench.state(), State::idle);
}

TEST(Machine, ArmsAgainButNotForEver) {
  auto bench = armed_bench();
  int arm_requests = 0;
  for (int i = 0; i < 20 && bench.state() == State::arm; ++i) {
    bench.flight().is_armed = false;  // by itself, after ten seconds on the ground
    for (auto const& said : bench.run_for(4s)) {
      auto const arms = requests<request::Arm>(said);
      if (arms.empty() || !arms.front().is_to_arm) continue;
      ++arm_requests;
      bench.flight().is_armed = true;
    }
    if (bench.state() == State::arm) bench.run_for(10s);
  }
  EXPECT_EQ(bench.state(), State::idle);
  EXPECT_EQ(arm_requests, 5);
}

TEST(Machine, TakesBackALateArmingAfterDisarm) {
  Bench bench;
  bench.give(command::Arm{});
  bench.flight().mode = guided;
  bench.step();
  bench.give(command::Disarm{});
  EXPECT_EQ(bench.said.state, State::idle);
  bench.run_for(2s);
  bench.flight().is_armed = true;  // the request was under way
  auto const arms = requests<request::Arm>(bench.step());
  ASSERT_EQ(arms.size(), 1u);
  EXPECT_FALSE(arms.front().is_to_arm);
  EXPECT_FALSE(arms.front().by_force);
}

TEST(Machine, TellsWhenTheFlightControllerDoesNotDisarm) {
  auto bench = armed_bench();
  bench.give(command::Disarm{});
  auto const all = bench.run_for(11s);
  EXPECT_GE(requests<request::Arm>(all).size(), 9u);
  EXPECT_EQ(std::ranges::count_if(all, [](auto const& said) { return tells(said, "does not disarm"); }), 1);
}

TEST(Machine, DisarmsOnTheGroundWhenTheLinkIsLost) {
  auto bench = armed_bench();
  bench.told.link = {.is_up = false, .silence = 3100ms};
  bench.step();
  EXPECT_EQ(bench.said.state, State::communication_lost);
  auto const arms = requests<request::Arm>(bench.said);
  ASSERT_EQ(arms.size(), 1u);
  EXPECT_FALSE(arms.front().is_to_arm);
  bench.flight().is_armed = false;
  EXPECT_EQ(bench.step().state, State::idle);
}

// ---- the climb

TEST(Machine, TakesOffToTheDesiredHeight) {
  auto bench = armed_bench();
  bench.give(command::Takeoff{});
  auto takeoffs = requests<request::Takeoff>(bench.said);
  ASSERT_EQ(takeoffs.size(), 1u);
  EXPECT_EQ(takeoffs.front().height_m, 10.0);
  takeoffs = requests<request::Takeoff>(bench.run_for(3s));
  EXPECT_EQ(takeoffs.size(), 3u) << "asked again as long as it stands";
  bench.fly_at(9.4);
  bench.step();
  EXPECT_EQ(bench.said.state, State::takeoff);
  EXPECT_TRUE(requests<request::Takeoff>(bench.run_for(3s)).empty());
  bench.fly_at(9.5);
  EXPECT_EQ(bench.step().state, State::hover);
}

TEST(Machine, TakesNothingUpThatIsUp) {
  auto bench = armed_bench();
  bench.fly_at(5.1);
  bench.give(command::Takeoff{});
  EXPECT_TRUE(requests<request::Takeoff>(bench.said).empty());
  EXPECT_EQ(bench.step().state, State::hover);
}

TEST(Machine, SeesALostLinkDuringTheClimbAtOnce) {
  auto bench = bench_in(State::takeoff);
  bench.fly_at(4.0);
  bench.step();
  bench.told.link.silence = 3s + 1ms;
  bench.step();
  EXPECT_EQ(bench.said.state, State::communication_lost);
  EXPECT_TRUE(asks_for(bench.said, "RTL"));
  EXPECT_FALSE(bench.said.sends_heartbeat);
}

TEST(Machine, CallsAClimbThatGetsNowhereAMalfunction) {
  auto bench = bench_in(State::takeoff);
  bench.fly_at(3.0);
  bench.run_for(34s);
  EXPECT_EQ(bench.state(), State::takeoff);
  bench.run_for(2s);
  EXPECT_EQ(bench.state(), State::malfunction);
  EXPECT_EQ(bench.said.health.reason, "the climb to 10.0 m did not end in time");
}

// ---- in the air

TEST(Machine, LooksForWhatMattersMostFirst) {
  auto bench = hovering_bench();
  bench.flight().battery = 0.1;
  auto all = bench;
  EXPECT_EQ(bench.give(command::AutonomousExplore{}).state, State::land);
  EXPECT_TRUE(tells(bench.said, "Autonomous Explore is not taken in Land, which takes Kill"));
  all.told.link.silence = 4s;
  auto failing = all;
  EXPECT_EQ(all.step().state, State::communication_lost);
  failing.told.processes.front().is_well = false;
  EXPECT_EQ(failing.step().state, State::malfunction);
  failing.told.commands.emplace_back(command::Kill{});
  EXPECT_EQ(failing.step().state, State::idle);
}

TEST(Machine, CallsAProcessFailedAfterThreeMissedReports) {
  auto bench = hovering_bench();
  bench.told.processes.back().silence = 3s;
  EXPECT_EQ(bench.step().state, State::hover);
  bench.told.processes.back().silence = 3s + 1ms;
  EXPECT_EQ(bench.step().state, State::malfunction);
  EXPECT_EQ(bench.said.health, (Health{false, "planner has not reported for 3.0 s"}));
}

TEST(Machine, WritesTheDiagnosticsOfAMalfunctionOnce) {
  auto bench = hovering_bench();
  bench.flight().is_critical = true;
  bench.step();
  ASSERT_TRUE(bench.said.diagnostics);
  EXPECT_TRUE(bench.said.diagnostics->starts_with("reason: the flight controller calls its own state critical\n"));
  EXPECT_TRUE(bench.said.diagnostics->contains("\nbattery: 0.900\n"));
  for (auto const& said : bench.run_for(3s)) EXPECT_FALSE(said.diagnostics);
}

TEST(Machine, WaitsALittleForGpsAndBattery) {
  auto bench = hovering_bench();
  bench.flight().gps_fix = 1;
  bench.run_for(3s);
  EXPECT_EQ(bench.state(), State::hover);
  bench.run_for(200ms);
  EXPECT_EQ(bench.state(), State::malfunction);
  bench = hovering_bench();
  bench.flight().battery.reset();
  bench.run_for(6s);
  EXPECT_EQ(bench.state(), State::malfunction);
}

TEST(Machine, ReturnsEarlierTheFurtherItIsFromHome) {
  auto bench = hovering_bench();
  bench.flight().drain = vehicle::Drain{.per_s = 1.0 / 1200.0};
  bench.flight().battery = 0.2;
  EXPECT_EQ(bench.step().state, State::hover) << "15 % are enough here";
  bench.flight().position = geo::displaced(home_place, {.north = 1000, .east = 0, .down = 0});
  EXPECT_EQ(bench.step().state, State::land);
  EXPECT_TRUE(tells(bench.said, "the battery has 20 %, and the way home and the landing need 21 %"));
}

TEST(Machine, HoldsWhereItIsTenTimesASecond) {
  auto bench = moving_bench();
  bench.flight().local = geo::Point3<ArmingFrame>(3, 4, 11);
  bench.flight().relative_alt_m = 11;
  bench.run_for(4s);  // nobody judges the place
  ASSERT_EQ(bench.state(), State::hover);
  auto const setpoints = requests<request::LocalSetpoint>(bench.run_for(2s));
  EXPECT_EQ(setpoints.size(), 20u);
  for (auto const& setpoint : setpoints) EXPECT_EQ(setpoint.place, geo::Point3<ArmingFrame>(3, 4, 11));
}

TEST(Machine, MovesWhenThePlannerHasAgreed) {
  auto bench = moving_bench();
  ASSERT_TRUE(bench.said.wanted_place);
  EXPECT_EQ(bench.said.wanted_place->place, geo::Point3<ArmingFrame>(30, 40, 10));
  for (auto const& setpoint : requests<request::LocalSetpoint>(bench.run_for(1s)))
    EXPECT_EQ(setpoint.place, geo::Point3<ArmingFrame>(0, 0, 10)) << "it waits here";
  bench.told.place = {.is_in_lot = true, .at = bench.now};
  bench.run_for(100ms);
  auto const setpoints = requests<request::LocalSetpoint>(bench.run_for(1s));
  EXPECT_EQ(setpoints.size(), 10u);
  for (auto const& setpoint : setpoints) EXPECT_EQ(setpoint.place, geo::Point3<ArmingFrame>(30, 40, 10));
}

TEST(Machine, BelievesNoVerdictAboutThePlaceBefore) {
  auto bench = bench_in(State::desired_location_error);
  EXPECT_EQ(bench.said.user_error, UserError::desired_location_out_of_bounds);
  bench.told.place = {.is_in_lot = false, .at = bench.now};
  bench.give(command::AutonomousMove{.place = {1, 2}});
  EXPECT_EQ(bench.said.user_error, UserError::none);
  bench.run_for(2s);
  EXPECT_EQ(bench.state(), State::autonomous_move);
}

TEST(Machine, RefusesPlacesThatMakeNoSense) {
  auto bench = hovering_bench();
  double constexpr nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(bench.give(command::AutonomousMove{.place = {nan, 2}}).state, State::hover);
  EXPECT_TRUE(tells(bench.said, "Autonomous Move is refused: the wanted place has a coordinate that is no number"));
  EXPECT_EQ(bench.give(command::CompulsiveMove{.place = geo::Point<ArmingFrame>(900, 900)}).state, State::hover);
  EXPECT_TRUE(tells(bench.said, "1273 m from where the drone was armed, and 1000 m is the limit"));
  EXPECT_EQ(bench.give(command::CompulsiveMove{.place = geo::Wgs84::from_degrees(-43, 79)}).state, State::hover);
  bench.told.lot = geo::Box<ArmingFrame>{geo::Point<ArmingFrame>(0, 0), geo::Point<ArmingFrame>(50, 50)};
  EXPECT_EQ(bench.give(command::AutonomousMove{.place = {200, 50}}).state, State::hover);
  EXPECT_TRUE(tells(bench.said, "the wanted place is 150 m from the parking lot"));
  EXPECT_EQ(bench.give(command::CompulsiveMove{.place = geo::Point<ArmingFrame>(200, 50)}).state,
            State::compulsive_move);
}

TEST(Machine, FliesToAPlaceOnTheGlobeWhateverTheMapSays) {
  auto bench = bench_in(State::compulsive_move);
  auto const setpoints = requests<request::GlobalSetpoint>(bench.run_for(1s));
  EXPECT_EQ(setpoints.size(), 10u);
  EXPECT_NEAR(geo::surface_distance_m(setpoints.back().place, home_place), 50.0, 0.01);
  EXPECT_EQ(setpoints.back().height_m, 10.0);
}

TEST(Machine, PassesOnWhatThePlannerWantsAsLongAsItMakesSense) {
  auto bench = bench_in(State::autonomous_explore);
  EXPECT_TRUE(requests<request::LocalSetpoint>(bench.run_for(1s)).empty()) << "it sends its own, or none";
  geo::Point3<ArmingFrame> const here(0, 0, 10);
  geo::Point3<ArmingFrame> const there(20, 30, 12);
  bench.told.setpoint = {.place = there, .at = bench.now};
  auto setpoints = requests<request::LocalSetpoint>(bench.run_for(1s));
  EXPECT_EQ(setpoints.size(), 10u);
  for (auto const& one : setpoints) EXPECT_EQ(one.place, there);
  setpoints = requests<request::LocalSetpoint>(bench.run_for(1s));
  EXPECT_EQ(setpoints.size(), 10u) << "it is old";
  for (auto const& one : setpoints) EXPECT_EQ(one.place, here);
}

TEST(Machine, RefusesSetpointsOfThePlannerThatMakeNoSenseAndTellsItOnce) {
  double constexpr nan = std::numeric_limits<double>::quiet_NaN();
  for (auto const& [place, words] : std::initializer_list<std::pair<geo::Point3<ArmingFrame>, std::string>>{
           {{nan, 0, 10}, "a coordinate that is no number"},
           {{0, 2000, 10}, "2000 m from where the drone was armed"},
           {{0, 0, 5}, "the wanted height (5.0 m) is below the lowest hover height"},
           {{0, 0, 21}, "the wanted height (21.0 m) is above the highest hover height"}}) {
    auto bench = bench_in(State::autonomous_explore);
    int told = 0;
    for (int i = 0; i < 20; ++i) {
      bench.told.setpoint = {.place = place, .at = bench.now};
      bench.step();
      told += tells(bench.said, words) ? 1 : 0;
      for (auto const& one : requests<request::LocalSetpoint>(bench.said))
        EXPECT_EQ(one.place, geo::Point3<ArmingFrame>(0, 0, 10));
    }
    EXPECT_EQ(told, 1) << words;
  }
}

TEST(Machine, ClearsTheUserErrorWhenTheStateEnds) {
  auto bench = bench_in(State::no_parking_lot_detected);
  EXPECT_EQ(bench.said.user_error, UserError::no_lot_detected);
  EXPECT_EQ(bench.step().user_error, UserError::no_lot_detected);
  EXPECT_EQ(bench.give(command::Land{}).user_error, UserError::none);
}

TEST(Machine, LeavesThePilotAlone) {
  auto bench = moving_bench();
  bench.flight().mode = "LOITER";
  bench.step();
  EXPECT_EQ(bench.said.state, State::hover);
  EXPECT_TRUE(tells(bench.said, "somebody else flies it in mode LOITER"));
  for (auto const& said : bench.run_for(5s)) {
    EXPECT_TRUE(said.requests.empty());
    EXPECT_TRUE(said.error_log.empty());
  }
  EXPECT_EQ(bench.give(command::AutonomousExplore{}).state, State::hover);
  EXPECT_TRUE(tells(bench.said, "he has to give it back in mode GUIDED first"));
  bench.flight().local = geo::Point3<ArmingFrame>(7, 8, 12);
  bench.flight().relative_alt_m = 12;
  bench.flight().mode = guided;
  bench.step();
  auto const setpoints = requests<request::LocalSetpoint>(bench.said);
  ASSERT_EQ(setpoints.size(), 1u);
  EXPECT_EQ(setpoints.front().place, geo::Point3<ArmingFrame>(7, 8, 12));
  EXPECT_EQ(bench.give(command::AutonomousExplore{}).state, State::autonomous_explore);
}

TEST(Machine, TakesOverADroneThatItFindsFlying) {
  Bench bench;
  bench.fly_at(12);
  bench.step();
  EXPECT_EQ(bench.said.state, State::hover);
  EXPECT_TRUE(tells(bench.said, "was flying when this program started"));
  Bench later;
  later.step();
  later.fly_at(12);
  EXPECT_EQ(later.step().state, State::idle) << "somebody else has started it meanwhile";
}

TEST(Machine, CanLandWhatSomebodyElseStarted) {
  Bench bench;
  bench.step();
  bench.fly_at(12);
  bench.step();
  EXPECT_EQ(bench.give(command::Land{}).state, State::land);
}

// ---- down

TEST(Machine, SetsTheHeightOfTheReturnOnceInMetres) {
  auto bench = hovering_bench();
  bench.give(command::Land{});
  ASSERT_EQ(bench.said.requests.size(), 2u);
  EXPECT_EQ(std::get<request::ReturnAltitude>(bench.said.requests[0]).height_m, 10.0);
  EXPECT_EQ(std::get<request::Mode>(bench.said.requests[1]).mode, "RTL");
  EXPECT_TRUE(requests<request::ReturnAltitude>(bench.run_for(10s)).empty());
}

TEST(Machine, AsksForTheReturnUntilItIsSeenAndThenNoMore) {
  auto bench = hovering_bench();
  bench.give(command::Land{});
  EXPECT_EQ(requests<request::Mode>(bench.run_for(3s)).size(), 3u);
  bench.flight().mode = "RTL";
  EXPECT_TRUE(bench.step().requests.empty());
  bench.flight().mode = "LOITER";  // a pilot has his reason
  for (auto const& said : bench.run_for(10s)) EXPECT_TRUE(said.requests.empty());
}

TEST(Machine, LandsHereWhenItCannotReturn) {
  for (auto const state : {State::land, State::communication_lost, State::malfunction}) {
    auto bench = bench_in(state);
    bench.run_for(5s);
    std::set<std::string_view> modes;
    for (auto const& one : requests<request::Mode>(bench.run_for(3s))) modes.insert(one.mode);
    EXPECT_EQ(modes, std::set<std::string_view>{"LAND"}) << to_string(state);
  }
}

TEST(Machine, AsksBlindlyForTheReturnOfAFlightControllerThatIsNotHeard) {
  auto bench = hovering_bench();
  bench.flight().silence = 3s;
  EXPECT_EQ(bench.step().state, State::malfunction);
  for (auto const& one : requests<request::Mode>(bench.run_for(20s))) EXPECT_EQ(one.mode, "RTL");
}

TEST(Machine, WaitsInTheAirWhenTheLinkIsBackAndLandsWhenItIsLow) {
  auto bench = bench_in(State::communication_lost);
  auto low = bench;
  bench.told.link = {.is_up = true, .silence = 0s};
  EXPECT_EQ(bench.step().state, State::hover);
  EXPECT_TRUE(bench.said.sends_heartbeat);
  low.fly_at(1.5);
  low.told.link = {.is_up = true, .silence = 0s};
  EXPECT_EQ(low.step().state, State::communication_lost);
}

// ---- Kill

class KillInEachState : public ::testing::TestWithParam<State> {};

TEST_P(KillInEachState, StopsTheMotorsUntilItIsDisarmed) {
  auto bench = bench_in(GetParam());
  bench.flight().is_armed = true;
  bench.told.commands = {command::Land{}, command::Kill{}, command::Arm{}};
  bench.step();
  EXPECT_EQ(bench.said.state, State::idle);
  auto const first = requests<request::Arm>(bench.said);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_TRUE(!first.front().is_to_arm && first.front().by_force);
  EXPECT_TRUE(tells(bench.said, "Land is overtaken by Kill"));
  EXPECT_TRUE(tells(bench.said, "Arm is overtaken by Kill"));
  bench.give(command::Land{});
  EXPECT_EQ(bench.said.state, State::idle);
  EXPECT_TRUE(tells(bench.said, "Land is refused: Kill stops the motors"));
  EXPECT_GE(requests<request::Arm>(bench.run_for(60s)).size(), 200u);
  bench.flight().is_armed = false;
  bench.step();
  EXPECT_TRUE(bench.run_for(10s).back().requests.empty());
}

INSTANTIATE_TEST_SUITE_P(All, KillInEachState, ::testing::ValuesIn(all_states), state_name);

TEST(Machine, KillsWhatAnEarlierRequestArmsAfterwards) {
  auto bench = armed_bench();
  bench.flight().is_armed = false;
  bench.give(command::Kill{});
  bench.run_for(2s);
  bench.flight().is_armed = true;
  auto const arms = requests<request::Arm>(bench.run_for(500ms));
  ASSERT_FALSE(arms.empty());
  EXPECT_TRUE(arms.front().by_force);
}

TEST(Machine, ArmsAgainWhenKillIsOver) {
  auto bench = hovering_bench();
  bench.give(command::Kill{});
  bench.flight() = *ready().flight;
  bench.run_for(6s);
  EXPECT_EQ(bench.give(command::Arm{}).state, State::arm);
}

TEST(Machine, AnswersCommandsInTheirOrder) {
  Bench bench;
  bench.step();
  bench.told.commands = {command::Arm{}, command::Takeoff{}, command::Disarm{}, command::Disarm{}};
  bench.step();
  EXPECT_EQ(bench.said.state, State::idle);
  ASSERT_EQ(bench.said.error_log.size(), 2u);
  EXPECT_EQ(bench.said.error_log[0], "Takeoff is refused: it is not armed yet: wait until it is");
  EXPECT_EQ(bench.said.error_log[1], "Disarm is refused: it is not armed");
}

}  // namespace
}  // namespace lapwing::autonomy
