#include "autonomy/states/machine.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

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

TEST(Machine, TellsHowLongItMayFlyOnceConsumptionIsKnown) {
  auto bench = hovering_bench();
  EXPECT_FALSE(bench.step().flying_time_left);
  bench.flight().drain = vehicle::Drain{.per_s = 1.0 / 1200.0};
  bench.flight().battery = 0.65;
  ASSERT_TRUE(bench.step().flying_time_left);
  EXPECT_NEAR(base::to_seconds(*bench.said.flying_time_left), 600.0, 1e-6);
  bench.flight().silence = 5s;
  EXPECT_FALSE(bench.step().flying_time_left) << "nobody knows the charge by now";
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

}  // namespace
}  // namespace lapwing::autonomy
