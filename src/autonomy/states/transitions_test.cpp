#include "autonomy/states/transitions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>

#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

// The specification once more, by names, and not by what the table is made of: of each state where each event leads.
using Leads = std::map<std::string, std::string>;

Leads const on_the_way_down{{"Kill", "Idle"}, {"disarmed", "Idle"}};

Leads flight(Leads own) {
  own.insert({{"Kill", "Idle"},
              {"failure", "Malfunction"},
              {"link lost", "CommunicationLost"},
              {"battery low", "Land"},
              {"Land", "Land"},
              {"Autonomous Explore", "AutonomousExplore"},
              {"Autonomous Move", "AutonomousMove"},
              {"Compulsive Move", "CompulsiveMove"},
              {"disarmed", "Idle"},
              {"returns", "Land"},
              {"by hand", "Hover"}});
  return own;
}

Leads with_link_back() {
  auto leads = on_the_way_down;
  leads["link back"] = "Hover";
  return leads;
}

std::map<std::string, Leads> const specification{
    {"Idle", {{"Kill", "Idle"}, {"Arm", "Arm"}, {"Configure", "Configure"}, {"Disarm", "Idle"}, {"Land", "Land"}}},
    {"Configure", {{"Kill", "Idle"}, {"at once", "Idle"}}},
    {"Arm",
     {{"Kill", "Idle"},
      {"Takeoff", "Takeoff"},
      {"Disarm", "Idle"},
      {"link lost", "CommunicationLost"},
      {"failure", "Malfunction"},
      {"not in time", "Idle"}}},
    {"Takeoff",
     {{"Kill", "Idle"},
      {"at height", "Hover"},
      {"disarmed", "Arm"},
      {"link lost", "CommunicationLost"},
      {"failure", "Malfunction"},
      {"Land", "Land"},
      {"returns", "Land"},
      {"by hand", "Hover"},
      {"not in time", "Malfunction"}}},
    {"Hover", flight({})},
    {"AutonomousExplore", flight({{"lot lost", "NoParkingLotDetected"}})},
    {"AutonomousMove", flight({{"outside", "DesiredLocationError"}, {"there", "Hover"}, {"no verdict", "Hover"}})},
    {"CompulsiveMove", flight({{"there", "Hover"}})},
    {"DesiredLocationError", flight({})},
    {"NoParkingLotDetected", flight({})},
    {"Land", on_the_way_down},
    {"CommunicationLost", with_link_back()},
    {"Malfunction", on_the_way_down},
};

/// How each event comes about.
struct Cause {
  std::string event;
  void (*make)(Bench&);
};

void reach(Bench& bench) {
  bench.flight().local = geo::Point3<ArmingFrame>(30, 40, 10);
  bench.flight().position = geo::displaced(home_place, {.north = 40, .east = 30, .down = -10});
  bench.now += 1s;
  bench.told.place = {.is_in_lot = true, .at = bench.now};
  bench.step();  // in which the planner's word is taken
}

void on_the_ground_armed(Bench& bench) {
  if (bench.state() == State::idle) bench.flight().is_armed = true;
}

std::vector<Cause> const causes{
    {"Kill", [](Bench& b) { b.told.commands.emplace_back(command::Kill{}); }},
    {"failure", [](Bench& b) { b.told.processes.back().silence = 4s; }},
    {"link lost", [](Bench& b) { b.told.link.silence = 3100ms; }},
    {"battery low", [](Bench& b) { b.flight().battery = 0.19; }},
    {"Configure", [](Bench& b) { b.told.commands.emplace_back(command::Configure{{8, 9, 10}}); }},
    {"Arm", [](Bench& b) { b.told.commands.emplace_back(command::Arm{}); }},
    {"Disarm",
     [](Bench& b) {
       on_the_ground_armed(b);
       b.told.commands.emplace_back(command::Disarm{});
     }},
    {"Takeoff", [](Bench& b) { b.told.commands.emplace_back(command::Takeoff{}); }},
    {"Land",
     [](Bench& b) {
       on_the_ground_armed(b);
       b.told.commands.emplace_back(command::Land{});
     }},
    {"Autonomous Explore", [](Bench& b) { b.told.commands.emplace_back(command::AutonomousExplore{}); }},
    {"Autonomous Move", [](Bench& b) { b.told.commands.emplace_back(command::AutonomousMove{.place = {5, 6}}); }},
    {"Compulsive Move", [](Bench& b) { b.told.commands.emplace_back(command::CompulsiveMove{.place = home_place}); }},
    {"disarmed", [](Bench& b) { b.flight().is_armed = false; }},
    {"returns", [](Bench& b) { b.flight().mode = "RTL"; }},
    {"by hand", [](Bench& b) { b.flight().mode = "LOITER"; }},
    {"at once", [](Bench&) {}},
    {"not in time",
     [](Bench& b) {
       if (b.state() == State::arm) b.flight().is_armed = false;
       b.now += 60s;
     }},
    {"at height", [](Bench& b) { b.flight().relative_alt_m = 9.6; }},
    {"there", reach},
    {"outside",
     [](Bench& b) {
       b.now += 1s;
       b.told.place = {.is_in_lot = false, .at = b.now};
     }},
    {"no verdict", [](Bench& b) { b.now += 4s; }},
    {"lot lost", [](Bench& b) { b.told.sees_lot = false; }},
    {"link back", [](Bench& b) { b.told.link = {.is_up = true, .silence = 0s}; }},
};

class EachState : public ::testing::TestWithParam<State> {};

TEST_P(EachState, GoesWhereTheSpecificationSaysAtEachEvent) {
  std::string const from(to_string(GetParam()));
  auto const& leads = specification.at(from);
  for (auto const& [event, make] : causes) {
    auto bench = bench_in(GetParam());
    ASSERT_EQ(to_string(bench.state()), from);
    make(bench);
    bench.step();
    auto expected = leads.find(event);
    // Configure does not stay, and a wait is over for a move that nobody has judged, whatever it waits for.
    bool const is_over = from == "AutonomousMove" && event == "not in time";
    if (from == "Configure" && expected == leads.end()) expected = leads.find("at once");
    if (is_over) expected = leads.find("no verdict");
    EXPECT_EQ(to_string(bench.state()), expected == leads.end() ? from : expected->second) << event;
  }
}

TEST_P(EachState, TakesNoOtherCommandThanTheSpecificationSays) {
  auto const& leads = specification.at(std::string(to_string(GetParam())));
  for (std::size_t i = 0; i < command_count; ++i) {
    std::string const name(command_name(i));
    bool const is_taken = std::ranges::any_of(transition_table(), [&](Transition const& row) {
      return is_command(row.event) && row.from.has(GetParam()) && to_string(row.event) == name;
    });
    EXPECT_EQ(is_taken, leads.contains(name)) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EachState, ::testing::ValuesIn(all_states), state_name);

TEST(Transitions, OfOneStateAndEventThereIsOne) {
  std::set<std::pair<State, Event>> seen;
  for (auto const& row : transition_table())
    for (auto const state : all_states) {
      if (!row.from.has(state)) continue;
      EXPECT_TRUE(seen.emplace(state, row.event).second) << to_string(state) << ", " << to_string(row.event);
    }
}

TEST(Transitions, EachEventLeadsSomewhere) {
  for (std::size_t i = 0; i < event_count; ++i)
    EXPECT_TRUE(std::ranges::any_of(transition_table(), [&](auto const& row) {
      return row.event == static_cast<Event>(i);
    })) << to_string(static_cast<Event>(i));
}

TEST(Transitions, BehavioursStandAtTheirStates) {
  for (auto const state : all_states) EXPECT_EQ(behaviour_of(state).state, state);
}

}  // namespace
}  // namespace lapwing::autonomy
