// Explores all that the machine can come to: breadth first over what its memory amounts to, with whatever may be the
// case in a frame, two mishaps or one and a command at a time. Of each memory it is asked whether an armed drone comes
// down.

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "autonomy/testing/bench.hpp"

namespace lapwing::autonomy {
namespace {

using namespace testing;

/// What memories have in common that behave alike: times count only by whether they are over, and what a state does not
/// look at counts not at all.
using Kind = std::tuple<State, UserError, bool, bool, bool, bool, bool, bool, int, bool, bool, bool>;

Kind kind_of(Bench const& bench) {
  auto const& m = bench.machine.memory();
  bool const arms = m.state == State::arm || m.state == State::takeoff;
  bool const is_refused = m.mode.first_asked && bench.now - *m.mode.first_asked > 5s;
  int const arm_requests = m.arm_requests == 0 ? 0 : m.arm_requests < 5 ? 1 : 2;
  return {m.state,
          m.user_error,
          m.state != State::idle && m.mode.is_seen,
          m.state != State::idle && is_refused,
          m.has_met_flight_controller,
          m.is_killed,
          m.disarms_until.has_value(),
          m.state == State::arm && m.was_armed,
          arms ? arm_requests : 0,
          m.state == State::autonomous_move && m.is_agreed,
          m.is_flown_by_hand,
          m.state == State::takeoff && m.next_takeoff == base::TimePoint::max()};
}

using Fact = void (*)(Bench&);
using Facts = std::vector<Fact>;

void nothing(Bench&) {}

/// Where the drone is and who flies it.
std::vector<Facts> const whereabouts{
    {[](Bench& b) { b.flight().is_armed = false; }, [](Bench& b) { b.flight().is_armed = true; }},
    {[](Bench& b) { b.flight().relative_alt_m = 0; }, [](Bench& b) { b.flight().relative_alt_m = 4; },
     [](Bench& b) { b.flight().relative_alt_m = 10; }},
    {[](Bench& b) { b.flight().mode = guided; }, [](Bench& b) { b.flight().mode = "RTL"; },
     [](Bench& b) { b.flight().mode = "LOITER"; }}};

/// What may be the case besides, two at a time.
Facts const mishaps{nothing,
                    [](Bench& b) { b.now += 60s; },
                    [](Bench& b) { b.told.link = {.is_up = false, .silence = 4s}; },
                    [](Bench& b) { b.flight().silence = 5s; },
                    [](Bench& b) { b.told.processes.front().is_well = false; },
                    [](Bench& b) { b.flight().battery = 0.1; },
                    [](Bench& b) { b.flight().local.reset(); },
                    [](Bench& b) { b.told.sees_lot = false; },
                    [](Bench& b) { b.told.place = {.is_in_lot = false, .at = b.now}; },
                    [](Bench& b) { b.told.place = {.is_in_lot = true, .at = b.now}; }};

Facts const commands{nothing,
                     [](Bench& b) { b.told.commands = {command::Kill{}}; },
                     [](Bench& b) { b.told.commands = {command::Configure{{1, 2, 3}}}; },
                     [](Bench& b) { b.told.commands = {command::Arm{}}; },
                     [](Bench& b) { b.told.commands = {command::Disarm{}}; },
                     [](Bench& b) { b.told.commands = {command::Takeoff{}}; },
                     [](Bench& b) { b.told.commands = {command::Land{}}; },
                     [](Bench& b) { b.told.commands = {command::AutonomousExplore{}}; },
                     [](Bench& b) { b.told.commands = {command::AutonomousMove{.place = {0, 0}}}; },
                     [](Bench& b) { b.told.commands = {command::CompulsiveMove{.place = home_place}}; }};

/// Calls `use` with the bench in each place that there is.
template <class Use>
void each_whereabouts(Bench const& bench, Use&& use, std::size_t which = 0) {
  if (which == whereabouts.size()) {
    use(bench);
    return;
  }
  for (auto const fact : whereabouts[which]) {
    auto changed = bench;
    fact(changed);
    each_whereabouts(changed, use, which + 1);
  }
}

/// Calls `use` with the bench after each frame that there can be: two mishaps, or one and a command.
template <class Use>
void each_next(Bench const& bench, Use&& use) {
  auto const try_both = [&](Bench const& from, Fact first, Fact second) {
    auto next = from;
    first(next);
    second(next);
    next.step();
    use(next);
  };
  each_whereabouts(bench, [&](Bench const& there) {
    for (std::size_t i = 0; i < mishaps.size(); ++i) {
      for (std::size_t k = i; k < mishaps.size(); ++k) try_both(there, mishaps[i], mishaps[k]);
      for (auto const give : commands) try_both(there, mishaps[i], give);
    }
  });
}

/// Setpoints are sent where it flies by them, and are numbers.
bool is_sound(Bench const& bench) {
  auto const local = requests<request::LocalSetpoint>(bench.said);
  bool const has_setpoint = !local.empty() || !requests<request::GlobalSetpoint>(bench.said).empty();
  return (!has_setpoint || flight_states.has(bench.state())) &&
         std::ranges::all_of(local, [](auto const& one) { return one.place.is_finite(); });
}

struct Explored {
  std::map<Kind, Bench> memories = {};
  std::size_t frames = 0;
  std::size_t unsound = 0;
};

Explored explore() {
  Explored all;
  std::deque<Kind> waiting;
  auto const add = [&](Bench const& bench) {
    ++all.frames;
    if (!is_sound(bench)) ++all.unsound;
    auto const kind = kind_of(bench);
    if (all.memories.contains(kind)) return;
    auto& kept = all.memories.emplace(kind, bench).first->second;
    kept.told = ready();
    waiting.push_back(kind);
  };
  add(Bench{});
  while (!waiting.empty()) {
    auto const bench = all.memories.at(waiting.front());
    waiting.pop_front();
    each_next(bench, add);
  }
  return all;
}

Explored const& explored() {
  static auto const all = explore();
  return all;
}

std::map<Kind, Bench> const& reachable() {
  return explored().memories;
}

std::string name(Bench const& bench) {
  auto const& m = bench.machine.memory();
  return fmt::format("{} killed {} by hand {} mode seen {}", to_string(m.state), m.is_killed, m.is_flown_by_hand,
                     m.mode.is_seen);
}

/// An armed drone in the air whose flight controller does what it is asked for, but for what it is told to refuse.
/// Whether it came to rest within the time.
bool comes_down(Bench bench, bool can_return, base::Duration within = 60s) {
  bench.told.link = {.is_up = false, .silence = 4s};
  double height_m = 10;
  for (auto const end = bench.now + within; bench.now < end;) {
    bench.step(200ms);
    for (auto const& one : requests<request::Arm>(bench.said))
      if (!one.is_to_arm && one.by_force) bench.flight().is_armed = false;
    for (auto const& one : requests<request::Mode>(bench.said))
      if (can_return || one.mode != "RTL") bench.flight().mode = one.mode;
    if (bench.flight().mode == "RTL" || bench.flight().mode == "LAND") height_m -= 0.4;
    bench.flight().relative_alt_m = height_m;
    if (height_m <= 0) bench.flight().is_armed = false;
    if (!bench.flight().is_armed && bench.state() == State::idle) return true;
  }
  return false;
}

TEST(EveryMemory, OfEachStateIsFound) {
  std::set<State> states;
  for (auto const& [kind, bench] : reachable()) states.insert(bench.state());
  EXPECT_EQ(states.size(), state_count);
  EXPECT_GT(reachable().size(), 100u);
  RecordProperty("memories", static_cast<int>(reachable().size()));
  RecordProperty("frames", static_cast<int>(explored().frames));
}

TEST(EveryMemory, StopsTheMotorsByKill) {
  for (auto const& [kind, found] : reachable()) {
    auto bench = found;
    bench.fly_at(10);
    bench.give(command::Kill{});
    EXPECT_EQ(bench.said.state, State::idle) << name(found);
    auto const arms = requests<request::Arm>(bench.said);
    ASSERT_EQ(arms.size(), 1u) << name(found);
    EXPECT_TRUE(!arms.front().is_to_arm && arms.front().by_force) << name(found);
  }
}

TEST(EveryMemory, BringsAnArmedDroneDownWhenTheOperatorIsLost) {
  int tried = 0;
  for (auto const& [kind, found] : reachable()) {
    // In Idle it is somebody else's, and in a descent that was seen a pilot's who took it.
    bool const is_others = found.state() == State::idle || found.state() == State::configure ||
                           (descents.has(found.state()) && found.machine.memory().mode.is_seen);
    if (is_others) continue;
    ++tried;
    for (auto const* const mode : {"GUIDED", "LOITER", "RTL"}) {
      auto bench = found;
      bench.fly_at(10);
      bench.flight().mode = mode;
      EXPECT_TRUE(comes_down(bench, true)) << name(found) << " from " << mode;
      EXPECT_TRUE(comes_down(bench, false) || bench.flight().mode == "RTL") << name(found) << " from " << mode;
    }
  }
  EXPECT_GT(tried, 50);
}

TEST(EveryMemory, LandsAnArmedDroneByCommand) {
  int tried = 0;
  for (auto const& [kind, found] : reachable()) {
    auto bench = found;
    bench.fly_at(10);
    bench.step();  // Configure lasts a frame
    bool const has_been_seen = descents.has(bench.state()) && bench.machine.memory().mode.is_seen;
    if (has_been_seen || bench.state() == State::arm) continue;
    if (bench.machine.memory().is_killed) {
      EXPECT_TRUE(comes_down(bench, true)) << name(found) << ": Kill insists";
      continue;
    }
    ++tried;
    bench.give(command::Land{});
    EXPECT_TRUE(descents.has(bench.state())) << name(found);
    EXPECT_TRUE(comes_down(bench, true)) << name(found);
  }
  EXPECT_GT(tried, 50);
}

TEST(EveryMemory, SendsSetpointsInFlightOnlyAndOnlyNumbers) {
  EXPECT_EQ(explored().unsound, 0u) << "of " << explored().frames << " frames";
}

}  // namespace
}  // namespace lapwing::autonomy
