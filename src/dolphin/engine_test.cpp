#include <gtest/gtest.h>

#include <algorithm>

#include "dolphin/testing.hpp"

/// Runs of scripts from outside: how they are stopped, watched, and what the platform does to them.
namespace lapwing::dolphin {
namespace {

using testing::Bench;

std::shared_ptr<Program const> loaded(Bench& bench, std::string const& script) {
  auto const source = std::make_shared<base::SourceFile const>("test.dolphin", script);
  base::Diagnostics diagnostics(*source);
  auto program = load(source, bench.platform.builders(), diagnostics);
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

TEST(Heap, LetsGoOfCyclesAtItsEnd) {
  // The sanitizers of the test build see to it that this leaks nothing.
  EXPECT_EQ(testing::printed("l = []\nl << l\ndef f = null\nf = { f }\nm = [:]\nm.self = m\nprint 'ok'"), "ok");
}

}  // namespace
}  // namespace lapwing::dolphin
