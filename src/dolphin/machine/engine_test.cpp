#include <gtest/gtest.h>

#include <algorithm>

#include "dolphin/testing/script_bench.hpp"

/// Runs of scripts from outside: how they are stopped, watched, and what the platform does to them.
namespace lapwing::dolphin {
namespace {

using testing::Bench;

std::shared_ptr<Program const> loaded(Bench& bench, std::string const& script) {
  auto const source = std::make_shared<base::SourceFile const>("test.dolphin", script);
  base::Diagnostics diagnostics(*source);
  auto program = load(source, bench.platform.vocabulary(), diagnostics);
  EXPECT_TRUE(program) << base::render(diagnostics);
  return program;
}

/// Calls `function` when the loop's time is `seconds`.
base::Task<void> at(base::Loop& loop, double seconds, std::function<void()> function) {
  co_await loop.sleep(base::from_seconds(seconds));
  function();
}

tasks::VehicleInfo copter(std::string id) {
  return {
      .id = {std::move(id)}, .type = "UAV", .payload = {}, .position = geo::Wgs84::from_degrees(41, -8), .battery = {}};
}

TEST(Engine, StopEndsTheRunningTasksAndReleasesTheirVehicles) {
  Bench bench;
  auto const program = loaded(bench, "v = pick {}\nexecute task('A:100')\nmessage 'no'");
  bench.options.on_event = [&](tasks::TaskEvent const& event) {
    bench.transcript.text += std::string(to_string(event.kind)) + " ";
  };
  Engine engine(bench.loop, bench.platform, bench.transcript, {}, bench.options);
  base::Scope scope(bench.loop);
  scope.spawn(at(bench.loop, 1.05, [&] { engine.stop(); }));
  auto const outcome = bench.loop.run_until_done(engine.run(program));
  EXPECT_EQ(exit_code(outcome), 130);
  EXPECT_EQ(bench.transcript.text, "ALLOC START STOP ");
  EXPECT_FALSE(engine.is_running());
  EXPECT_TRUE(engine.picked().empty());
}

/// Runs the script, stops it from outside after `seconds`; what it printed and its exit code.
std::string stopped_after(double seconds, std::string const& script) {
  Bench bench;
  auto const program = loaded(bench, script);
  bench.options.on_event = [&](tasks::TaskEvent const& event) {
    bench.transcript.text += std::string(to_string(event.kind)) + " ";
  };
  Engine engine(bench.loop, bench.platform, bench.transcript, {}, bench.options);
  base::Scope scope(bench.loop);
  scope.spawn(at(bench.loop, seconds, [&] { engine.stop(); }));
  auto const outcome = bench.loop.run_until_done(engine.run(program));
  return bench.transcript.text + std::to_string(exit_code(outcome));
}

TEST(Engine, StopRunsFinallyBlocksAfterTheTasksAreStopped) {
  EXPECT_EQ(stopped_after(1.05,
                          "v = pick {}\ndef f() { try { execute task('A:100') } catch (Throwable e) { print 'c' } "
                          "finally { print 'inner ' } }\n"
                          "try { f() } finally { release v\n print 'outer ' }\nprint 'no'"),
            "ALLOC START STOP inner outer 130");
  EXPECT_EQ(stopped_after(1.05, "try { while (true) { pause 0.1 } } finally { print 'looped ' }"), "looped 130");
  EXPECT_EQ(stopped_after(1.05, "try { pause 100 } finally { print 'paused ' }"), "paused 130");
}

TEST(Engine, StopLetsFinallyBlocksNotWait) {
  EXPECT_EQ(stopped_after(1.05,
                          "v = pick {}\ntry { pause 100 } finally { print 'a '\n try { pause 1\n print 'no' } "
                          "finally { print 'b ' }\n execute task('A:1') }"),
            "a b 130");
  EXPECT_EQ(stopped_after(1.05, "try { pause 100 } finally { while (true) { } }"), "130");
}

TEST(Action, ThatIsStoppedRunsItsFinallyBlocks) {
  EXPECT_EQ(testing::printed("execute during 0.3 run action { try { pause 10 } finally { print 'cleared' } }"),
            "cleared");
  auto const text = testing::printed(
      "t = action { try { pause 10 } finally { print 'left ' } }\n"
      "try { execute t | (idle(0.2) >> action { throw new RuntimeException('x') }) } "
      "catch (e) { print e.message }");
  EXPECT_EQ(text, "left x");
  EXPECT_EQ(stopped_after(1.05, "execute action { try { pause 10 } finally { print 'gone ' } }"), "gone 130");
  EXPECT_NE(
      testing::printed("execute action { try { pause 10 } finally { print 'halted' } } | (idle(0.2) >> action { halt "
                       "'enough' })")
          .find("haltedexit 3"),
      std::string::npos);
}

TEST(Action, MayReleaseVehiclesInItsFinallyBlock) {
  Bench bench;
  EXPECT_EQ(
      bench.run("v = pick {}\nexecute during 0.3 run (task('A:9') | action { try { pause 9 } finally { release v } })\n"
                "message pick { id 'a1' }"),
      "{\"t\":0,\"event\":\"ALLOC\",\"task\":\"A\",\"vehicle\":\"a1\"}\n"
      "{\"t\":0,\"event\":\"START\",\"task\":\"A\",\"vehicle\":\"a1\"}\n"
      "{\"t\":0.3,\"event\":\"STOP\",\"task\":\"A\",\"vehicle\":\"a1\"}\n"
      "Program message: { a1 }\nexit 0 at 0.4\n");
}

/// What the script writes, chance and clock included.
std::string written(std::string const& script, std::uint64_t seed) {
  Bench bench;
  bench.options.seed = seed;
  return bench.run(script);
}

TEST(Replay, TheSameScriptAndSeedGiveTheSameEvents) {
  std::string const script =
      "v = pick { count 2 }\n"
      "t = idle(0)\nfor (i in 1..20) { t = t >> task(\"T$i:${Math.random().round(2)}\") }\n"
      "execute t / { Math.random() < 0.02 }\nmessage Math.random()\n";
  EXPECT_EQ(written(script, 7), written(script, 7));
  EXPECT_NE(written(script, 7), written(script, 8));
}

TEST(Engine, ShowsTheTaskTreeAndTheLineOfTheScript) {
  Bench bench;
  auto const program = loaded(bench, "v = pick {}\nexecute v: task('A:1') >> task('B:1')");
  Engine engine(bench.loop, bench.platform, bench.transcript, {});
  std::optional<tasks::TaskView> view;
  int line = 0;
  base::Scope scope(bench.loop);
  scope.spawn(at(bench.loop, 0.55, [&] {
    view = engine.task_view();
    line = engine.line();
  }));
  EXPECT_EQ(exit_code(bench.loop.run_until_done(engine.run(program))), 0);
  ASSERT_TRUE(view);
  EXPECT_EQ(view->state, tasks::TaskState::running);
  EXPECT_EQ(line, 2);
  EXPECT_FALSE(engine.task_view());
}

TEST(Engine, EveryRunStartsAfresh) {
  Bench bench;
  Engine engine(bench.loop, bench.platform, bench.transcript, {});
  auto const program = loaded(bench, "message poll('a')\npost a: 1\nmessage pick { id 'a1' }");
  for (int i = 0; i < 2; ++i) EXPECT_EQ(exit_code(bench.loop.run_until_done(engine.run(program))), 0);
  EXPECT_EQ(bench.transcript.text,
            "Program message: false\nProgram message: { a1 }\nProgram message: false\nProgram message: { a1 }\n");
}

TEST(Pick, TakesAVehicleAsSoonAsItArrives) {
  Bench bench;
  base::Scope scope(bench.loop);
  scope.spawn(at(bench.loop, 2.3, [&] { bench.platform.set_vehicle(copter("z9")); }));
  EXPECT_EQ(bench.run("message pick { id 'z9'; timeout 30 }"), "Program message: { z9 }\nexit 0 at 2.3\n");
}

TEST(Pick, LeavesLostVehiclesAlone) {
  Bench bench;
  auto lost = copter("a1");
  lost.connected = false;
  bench.platform.set_vehicle(lost);
  EXPECT_EQ(bench.run("message pick { type 'UAV' }"), "Program message: { a2 }\nexit 0 at 0.0\n");
}

TEST(Battery, UnknownFailsEveryComparisonAndWarnsOnce) {
  Bench bench;
  bench.platform.set_vehicle(copter("z9"));
  base::LogHub hub;
  int warnings = 0;
  hub.add_sink([&](base::LogRecord const& record) { warnings += record.level == base::LogLevel::warn ? 1 : 0; });
  Engine engine(bench.loop, bench.platform, bench.transcript, base::Logger(hub, "script"));
  auto const program = loaded(bench, "v = pick { id 'z9' }\nprint battery(v) < 0.3\nprint battery(v) >= 0.9");
  EXPECT_EQ(exit_code(bench.loop.run_until_done(engine.run(program))), 0);
  EXPECT_EQ(bench.transcript.text, "falsefalse");
  EXPECT_EQ(warnings, 1);
}

/// Reports 0.5 when the loop's time is `seconds`.
struct LateReport {
  explicit LateReport(Bench& bench, double seconds) : scope(bench.loop) {
    auto silent = copter("z9");
    silent.battery_is_awaited = true;
    silent.connection_timeout = std::chrono::seconds(20);
    bench.platform.set_vehicle(silent);
    scope.spawn(at(bench.loop, seconds, [&bench, silent]() mutable {
      silent.battery = 0.5;
      silent.battery_is_awaited = false;
      bench.platform.set_vehicle(silent);
    }));
  }
  base::Scope scope;
};

TEST(Battery, IsWaitedForUntilItsFirstReport) {
  Bench bench;
  LateReport const report(bench, 3.0);
  EXPECT_EQ(bench.run("v = pick { id 'z9' }\nprint battery(v)"), "0.5exit 0 at 3.0\n");
}

/// Says where it is when the loop's time is `seconds`.
struct LatePosition {
  explicit LatePosition(Bench& bench, double seconds) : scope(bench.loop) {
    auto lost = copter("z9");
    lost.position.reset();
    lost.connection_timeout = std::chrono::seconds(20);
    bench.platform.set_vehicle(lost);
    scope.spawn(at(bench.loop, seconds, [&bench, found = lost]() mutable {
      found.position = geo::Wgs84::from_degrees(41.0, -8.0, 5.0);
      bench.platform.set_vehicle(found);
    }));
  }
  base::Scope scope;
};

TEST(Position, IsWaitedForNoLongerThanTheConnectionTimeout) {
  Bench bench;
  LatePosition const report(bench, 15.0);
  EXPECT_EQ(bench.run("setConnectionTimeout 10.seconds\nv = pick { id 'z9' }\n"
                      "try { print position(v) } catch (e) { print e.message }\nprint position(v)"),
            "the position of vehicle z9 is not known(41.000000,-8.000000,5.000)exit 0 at 15.0\n");
}

TEST(Battery, IsWaitedForOnceAndNoLongerThanTheConnectionTimeout) {
  Bench bench;
  LateReport const report(bench, 100.0);
  EXPECT_EQ(bench.run("setConnectionTimeout 10.seconds\nv = pick { id 'z9' }\nprint battery(v)\nprint battery(v)"),
            "NaNNaNexit 0 at 10.0\n");
}

TEST(Battery, KeepsNeitherGuardsNorOtherTasksWaiting) {
  Bench bench;
  LateReport const report(bench, 3.0);
  auto const script =
      "v = pick { id 'z9' }\n"
      "execute (action { print battery(v) } >> condition { battery(v) == 0.5 })\n"
      "      | (idle(1) >> action { print 'other ' }) | (condition { !(battery(v) >= 0) })";
  EXPECT_EQ(bench.run(script), "other 0.5exit 0 at 3.1\n");
}

TEST(Position, IsWaitedForUntilItsFirstReport) {
  Bench bench;
  LatePosition const report(bench, 3.0);
  EXPECT_EQ(bench.run("v = pick { id 'z9' }\nprint position(v).lat"), "41.0exit 0 at 3.0\n");
}

TEST(Position, ThatNeverComesIsAnExceptionAfterTheConnectionTimeout) {
  Bench bench;
  LatePosition const report(bench, 100.0);
  EXPECT_EQ(bench.run("v = pick { id 'z9' }\nprint position(v)"),
            "exit 1 at 20.0: test.dolphin:2: IllegalStateException: the position of vehicle z9 is not known\n");
}

TEST(Position, UnknownInAGuardIsNearNothingAndInNoArea) {
  Bench bench;
  LatePosition const report(bench, 3.0);
  auto const script =
      "v = pick { id 'z9' }\n"
      "here = location(41, -8)\n"
      "execute condition { position(v).near(here, 5) } | condition { position(v) in (here ^ 5) }\n"
      "print 'here'";
  EXPECT_EQ(bench.run(script), "hereexit 0 at 3.1\n");
}

TEST(VehicleInstructions, TellModeAndRelativeHeight) {
  Bench bench;
  auto flying = copter("z9");
  flying.mode = "AUTO";
  flying.relative_alt_m = 12.5;
  bench.platform.set_vehicle(flying);
  EXPECT_EQ(bench.run("v = pick { id 'z9' }\nprint mode(v) + ' ' + relativeHeight(v)"), "AUTO 12.5exit 0 at 0.0\n");
  flying.relative_alt_m.reset();
  bench.platform.set_vehicle(flying);
  bench.transcript.text.clear();
  EXPECT_EQ(bench.run("v = pick { id 'z9' }\nprint relativeHeight(v) > 10 || relativeHeight(v) <= 10"),
            "falseexit 0 at 0.0\n");
}

/// Loses a1 when the loop's time is 0.5.
struct Loss {
  explicit Loss(Bench& bench) : scope(bench.loop) {
    scope.spawn(at(bench.loop, 0.5, [&bench] {
      auto lost = *bench.platform.find({"a1"});
      lost.connected = false;
      bench.platform.set_vehicle(lost);
    }));
  }
  base::Scope scope;
};

std::string const two_tasks = "v = pick { id 'a1' }\nt = task('A:1') >> task('B:1')\n";

// A vehicle that breaks down is no mistake of the script: exit 3, not 1.
TEST(LostVehicle, HaltsTheScript) {
  Bench bench;
  Loss const loss(bench);
  auto const text = bench.run(two_tasks + "execute v: watch t onError { propagate() }");
  EXPECT_TRUE(text.ends_with("exit 3 at 1.1: test.dolphin:3: Halting program ... vehicle a1 is lost\n")) << text;
}

TEST(LostVehicle, CanBeDealtWith) {
  Bench bench;
  Loss const loss(bench);
  auto const text = bench.run(two_tasks + "try { execute v: t } catch (TaskError e) { print 'caught' }");
  EXPECT_TRUE(text.ends_with("caughtexit 0 at 1.1\n")) << text;
}

TEST(LostVehicle, HaltsWhenThereIsNoOtherForATask) {
  Bench bench;
  Loss const loss(bench);
  auto const text = bench.run(two_tasks + "pause 1\nexecute v: t");
  EXPECT_TRUE(text.starts_with("exit 3 at 1.0: test.dolphin:4: Halting program ... No vehicles to run task")) << text;
}

TEST(Heap, LetsGoOfCyclesAtItsEnd) {
  // The sanitizers of the test build see to it that this leaks nothing.
  EXPECT_EQ(testing::printed("l = []\nl << l\ndef f = null\nf = { f }\nm = [:]\nm.self = m\nprint 'ok'"), "ok");
}

}  // namespace
}  // namespace lapwing::dolphin
