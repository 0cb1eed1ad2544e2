#include "autonomy/states/machine.hpp"

#include <gtest/gtest.h>

#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

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

}  // namespace
}  // namespace lapwing::autonomy
