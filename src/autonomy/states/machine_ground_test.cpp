#include "autonomy/states/machine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

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
