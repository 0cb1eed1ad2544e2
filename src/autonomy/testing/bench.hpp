#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "autonomy/states/machine.hpp"

namespace lapwing::autonomy::testing {

using namespace std::chrono_literals;

inline constexpr base::Duration frame = 50ms;
inline geo::Wgs84 const home_place = geo::Wgs84::from_degrees(43.2585, -79.9201, 100.0);

/// A drone that stands at home, ready to be armed, with everybody well.
[[nodiscard]] inline Told ready() {
  Told told;
  told.link = {.is_up = true, .silence = 0s};
  told.flight = FlightController{.mode = "STABILIZE",
                                 .gps_fix = gps_fix_3d,
                                 .relative_alt_m = 0.0,
                                 .position = home_place,
                                 .local = geo::Point3<ArmingFrame>(0, 0, 0),
                                 .home = home_place,
                                 .battery = 0.9};
  for (auto const* const name : {"vision", "mapper", "planner"}) told.processes.push_back({name, 200ms});
  return told;
}

/// A machine with what it is told and its clock. What is told stays so until a test changes it; commands are given
/// once.
struct Bench {
  Machine machine = Machine();
  Told told = ready();
  base::TimePoint now = base::TimePoint(1h);
  Said said = {};

  [[nodiscard]] State state() const { return machine.memory().state; }
  [[nodiscard]] FlightController& flight() { return *told.flight; }

  Said const& step(base::Duration past = frame) {
    now += past;
    said = machine.step(told, now);
    told.commands.clear();
    return said;
  }
  Said const& give(Command command) {
    told.commands.push_back(std::move(command));
    return step();
  }
  /// All that was said on the way.
  std::vector<Said> run_for(base::Duration time) {
    std::vector<Said> all;
    for (auto const end = now + time; now < end;) all.push_back(step());
    return all;
  }

  void fly_at(double height_m) {
    flight().is_armed = true;
    flight().mode = guided;
    flight().relative_alt_m = height_m;
    flight().local = geo::Point3<ArmingFrame>(flight().local->x(), flight().local->y(), height_m);
  }
};

inline Bench armed_bench() {
  Bench bench;
  bench.step();
  bench.give(command::Arm{});
  bench.flight().mode = guided;
  bench.flight().is_armed = true;
  bench.step();
  return bench;
}

inline Bench hovering_bench() {
  auto bench = armed_bench();
  bench.give(command::Takeoff{});
  bench.fly_at(bench.machine.memory().heights.desired_m);
  bench.step();
  return bench;
}

inline Bench moving_bench() {
  auto bench = hovering_bench();
  bench.give(command::AutonomousMove{.place = {30, 40}});
  return bench;
}

/// In that state, in the usual way there.
inline Bench bench_in(State state) {
  using enum State;
  Bench bench = state == idle || state == configure                           ? Bench{}
                : state == arm || state == takeoff                            ? armed_bench()
                : state == autonomous_move || state == desired_location_error ? moving_bench()
                                                                              : hovering_bench();
  switch (state) {
    case configure: bench.give(command::Configure{{8, 12, 16}}); break;
    case takeoff: bench.give(command::Takeoff{}); break;
    case autonomous_explore: bench.give(command::AutonomousExplore{}); break;
    case compulsive_move: bench.give(command::CompulsiveMove{.place = geo::Point<ArmingFrame>(30, 40)}); break;
    case desired_location_error:
      bench.now += 1s;
      bench.told.place = {.is_in_lot = false, .at = bench.now};
      bench.step();
      bench.told.place.reset();
      break;
    case no_parking_lot_detected:
      bench.give(command::AutonomousExplore{});
      bench.told.sees_lot = false;
      bench.step();
      bench.told.sees_lot.reset();
      break;
    case land: bench.give(command::Land{}); break;
    case State::communication_lost:
      bench.told.link = {.is_up = false, .silence = 4s};
      bench.step();
      break;
    case malfunction:
      bench.told.processes.front().is_well = false;
      bench.step();
      bench.told.processes.front().is_well = true;
      break;
    default: bench.step(); break;
  }
  return bench;
}

/// The requests of one kind.
template <class T>
std::vector<T> requests(Said const& said) {
  std::vector<T> found;
  for (auto const& request : said.requests)
    if (auto const* const one = std::get_if<T>(&request)) found.push_back(*one);
  return found;
}
template <class T>
std::vector<T> requests(std::vector<Said> const& all) {
  std::vector<T> found;
  for (auto const& said : all)
    for (auto const& one : requests<T>(said)) found.push_back(one);
  return found;
}

/// Whether that is the one mode asked for.
inline bool asks_for(Said const& said, std::string_view mode) {
  auto const modes = requests<request::Mode>(said);
  return modes.size() == 1 && modes.front().mode == mode;
}

/// Whether some message for the operator has these words.
inline bool tells(Said const& said, std::string const& words) {
  for (auto const& text : said.error_log)
    if (text.contains(words)) return true;
  return false;
}

/// The name of a test of each state.
inline std::string state_name(::testing::TestParamInfo<State> const& parameter) {
  return std::string(to_string(parameter.param));
}

}  // namespace lapwing::autonomy::testing
