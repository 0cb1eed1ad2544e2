#include "autonomy/states/machine.hpp"

#include <gtest/gtest.h>

#include <set>

#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

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

}  // namespace
}  // namespace lapwing::autonomy
