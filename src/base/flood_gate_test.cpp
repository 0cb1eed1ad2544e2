#include "base/flood_gate.hpp"

#include <gtest/gtest.h>

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

UtcTime at(std::chrono::milliseconds since_start) {
  return UtcTime(since_start + 1000h);
}

/// How many of that many lines at one moment pass.
int passed(FloodGate& gate, int lines, std::chrono::milliseconds when) {
  int count = 0;
  for (int i = 0; i < lines; ++i) count += gate.admit(at(when)) ? 1 : 0;
  return count;
}

TEST(FloodGate, LetsABurstPassAndCountsTheRest) {
  FloodGate gate({.burst = 100, .per_s = 10});
  EXPECT_EQ(passed(gate, 500, 0ms), 100);
  EXPECT_EQ(gate.take_left_out(), 400U);
  EXPECT_EQ(gate.take_left_out(), 0U);
}

TEST(FloodGate, OpensForASecondsWorthAtATime) {
  FloodGate gate({.burst = 100, .per_s = 10});
  EXPECT_EQ(passed(gate, 200, 0ms), 100);
  EXPECT_EQ(passed(gate, 200, 900ms), 0);
  EXPECT_EQ(passed(gate, 200, 1100ms), 11);
}

TEST(FloodGate, NeverMeetsAnHonestSource) {
  FloodGate gate;
  EXPECT_EQ(passed(gate, 10'000, 0ms), 10'000) << "a long table at once";
  for (auto when = 1000ms; when < 10min; when += 10ms) EXPECT_TRUE(gate.admit(at(when))) << when.count();
}

TEST(FloodGate, FillsUpAgainInQuiet) {
  FloodGate gate({.burst = 100, .per_s = 10});
  EXPECT_EQ(passed(gate, 200, 0ms), 100);
  EXPECT_EQ(passed(gate, 200, 60s), 100);
}

TEST(FloodGate, GivesNothingForAClockThatIsSetBack) {
  FloodGate gate({.burst = 100, .per_s = 10});
  EXPECT_EQ(passed(gate, 200, 60s), 100);
  EXPECT_EQ(passed(gate, 200, 0ms), 0);
  EXPECT_EQ(passed(gate, 200, 1000ms), 10) << "and goes on from there";
}

TEST(FloodGate, SaysThatTheFloodIsOverOnlyOnceItIs) {
  FloodGate gate({.burst = 10, .per_s = 10});
  EXPECT_FALSE(gate.has_calmed(at(0ms)));
  EXPECT_EQ(passed(gate, 30, 0ms), 10);
  EXPECT_FALSE(gate.has_calmed(at(500ms)));
  EXPECT_TRUE(gate.has_calmed(at(1000ms)));
}

struct Log {
  Log() {
    hub.add_sink(
        without_floods([this](LogRecord const& record) { lines.push_back(record.source + ": " + record.text); }));
  }
  void say(std::string source, std::string text, std::chrono::milliseconds when,
           LogLevel level = LogLevel::info) const {
    hub.write({level, at(when), std::move(source), std::move(text)});
  }
  LogHub hub;
  std::vector<std::string> lines;
};

TEST(WithoutFloods, SaysHowManyLinesOfAFloodItLeftOut) {
  Log log;
  for (int i = 0; i < 22'345; ++i) log.say("script", "again", 0ms);
  EXPECT_EQ(log.lines.size(), 10'000U);
  log.say("script", "at last", 2s);
  ASSERT_EQ(log.lines.size(), 10'002U);
  EXPECT_EQ(log.lines[10'000], "script: 12,345 lines left out");
  EXPECT_EQ(log.lines[10'001], "script: at last");
}

TEST(WithoutFloods, SaysItWithAnybodysNextLineWhenTheFloodIsOver) {
  Log log;
  for (int i = 0; i < 10'007; ++i) log.say("script", "again", 0ms);
  log.say("fleet", "copter 1 landed", 5s);
  EXPECT_EQ(log.lines.at(10'000), "script: 7 lines left out");
  EXPECT_EQ(log.lines.at(10'001), "fleet: copter 1 landed");
}

TEST(WithoutFloods, HoldsBackNeitherOthersNorErrors) {
  Log log;
  for (int i = 0; i < 30'000; ++i) log.say("fleet", "again", 0ms);
  log.say("vehicle 1", "landed", 0ms);
  log.say("fleet", "EMERGENCY STOP", 0ms, LogLevel::error);
  ASSERT_EQ(log.lines.size(), 10'002U);
  EXPECT_EQ(log.lines[10'000], "vehicle 1: landed");
  EXPECT_EQ(log.lines[10'001], "fleet: EMERGENCY STOP");
}

}  // namespace
}  // namespace lapwing::base
