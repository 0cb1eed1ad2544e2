#include "tasks/execution.hpp"

#include <algorithm>
#include <numeric>

#include "tasks/testing/script.hpp"

namespace lapwing::tasks {
namespace {

using namespace testing;

struct ExecutionTest : ::testing::Test {
  TaskTree task(std::string_view name) { return stage.task(name); }
  Outcome execute(TaskTree const& tree) { return stage.execute(tree, {"a1", "a2"}); }
  auto& trace() { return stage.trace; }
  /// A watch whose handler notes what it was called about.
  TaskTree watched(TaskTree body, Verdict verdict) {
    return watch(std::move(body), procedure({.run = [this, verdict](auto const& cause) {
                   trace().push_back("E " + cause->message);
                   return std::expected<Verdict, Failure>(verdict);
                 }}));
  }
  Stage stage;
};

TEST_F(ExecutionTest, SequenceStartsTheNextInTheTickInWhichOneEnds) {  // case 34
  EXPECT_TRUE(execute(sequence(task("A:0.3"), task("B:0.3"))).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.3 DONE A@a1", "0.3 START B@a1", "0.6 DONE B@a1"}));
  EXPECT_DOUBLE_EQ(stage.now_s(), 0.7);
}

TEST_F(ExecutionTest, ConcurrentRunsBothAtOnce) {  // case 35
  EXPECT_TRUE(execute(concurrent(task("A:0.3"), task("B:0.5"))).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.0 START B@a2", "0.3 DONE A@a1", "0.5 DONE B@a2"}));
  EXPECT_DOUBLE_EQ(stage.now_s(), 0.6);
}

TEST_F(ExecutionTest, AThousandRunAtOnceEachInItsTurn) {
  std::vector<int> order;
  int tests = 0;
  auto all = idle(seconds(0.0));
  for (int i = 0; i < 1000; ++i) {
    auto const waits = wait_for(when([&tests, &order] { return ++tests > 0 && order.size() < 2000; }),
                                doing([&order, i] { order.push_back(i); }));
    all = concurrent(all, sequence(idle(seconds(0.1 * (i % 10))), waits));
  }
  EXPECT_TRUE(execute(all).is_done());
  ASSERT_EQ(order.size(), 1000u);
  EXPECT_EQ(tests, 1000);
  // Tick by tick, within one from the left to the right.
  auto expected = std::vector<int>(1000);
  std::iota(expected.begin(), expected.end(), 0);
  std::ranges::stable_sort(expected, {}, [](int i) { return i % 10; });
  EXPECT_EQ(order, expected);
  EXPECT_DOUBLE_EQ(stage.now_s(), 1.0);
}

TEST_F(ExecutionTest, OneErrorStopsAThousand) {
  int cancelled = 0;
  auto all = task("fail:0.3");
  for (int i = 0; i < 1000; ++i) {
    all = concurrent(all, action(procedure({.run = [](auto const&) { return std::expected<Verdict, Failure>(); },
                                            .returns_in_step = 1'000'000,
                                            .cancelled = &cancelled})));
  }
  auto const outcome = execute(all);
  ASSERT_TRUE(outcome.failure);
  EXPECT_EQ(outcome.failure->message, "boom");
  EXPECT_EQ(cancelled, 1000);
}

TEST_F(ExecutionTest, ErrorStopsTheSiblingAndComesOut) {  // case 37
  auto const outcome = execute(concurrent(task("fail:0.2"), task("B:5")));
  EXPECT_EQ(trace(), (Trace{"0.0 START fail@a1", "0.0 START B@a2", "0.2 ERROR fail@a1 boom", "0.2 STOP B@a2"}));
  ASSERT_TRUE(outcome.failure);
  EXPECT_EQ(outcome.failure->kind, FailureKind::task);
  EXPECT_EQ(outcome.failure->message, "boom");
  EXPECT_EQ(outcome.failure->culprit, "fail on a1");
}

TEST_F(ExecutionTest, SiblingToTheRightHasItsTurnInTheTickOfAnError) {
  EXPECT_FALSE(execute(concurrent(task("fail:0.2"), task("B:0.2"))).is_done());
  EXPECT_EQ(trace().back(), "0.2 DONE B@a2");
}

TEST_F(ExecutionTest, FirstErrorOfOneTickCounts) {
  auto const failing = restricted(sequence(task("fail:0.2"), task("B:1")), {{"a2"}});
  auto const outcome = execute(concurrent(failing, restricted(task("fail:0.2"), {{"a1"}})));
  EXPECT_EQ(outcome.failure->culprit, "fail on a2");
}

TEST_F(ExecutionTest, ErrorInASequenceNeverStartsTheRest) {
  EXPECT_FALSE(execute(sequence(task("fail:0.1"), task("B:1"))).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START fail@a1", "0.1 ERROR fail@a1 boom"}));
}

TEST_F(ExecutionTest, WatchIgnores) {  // case 39
  EXPECT_TRUE(execute(sequence(watched(task("fail:0.1"), Verdict::ignore), task("D:0.1"))).is_done());
  EXPECT_EQ(trace(),
            (Trace{"0.0 START fail@a1", "0.1 ERROR fail@a1 boom", "E boom", "0.1 START D@a1", "0.2 DONE D@a1"}));
}

TEST_F(ExecutionTest, WatchPropagates) {  // case 40
  auto const outcome = execute(sequence(watched(task("fail:0.1"), Verdict::propagate), task("D:0.1")));
  EXPECT_EQ(trace(), (Trace{"0.0 START fail@a1", "0.1 ERROR fail@a1 boom", "E boom"}));
  EXPECT_EQ(outcome.failure->message, "boom");
}

TEST_F(ExecutionTest, WatchIsNotCalledWhenItsBodySucceeds) {
  EXPECT_TRUE(execute(watched(task("A:0.1"), Verdict::propagate)).is_done());
  EXPECT_EQ(trace().size(), 2u);
}

TEST_F(ExecutionTest, WatchHandlerMayTakeItsTime) {
  auto const slow = procedure(
      {.run = [](auto const&) { return std::expected<Verdict, Failure>(Verdict::ignore); }, .returns_in_step = 4});
  EXPECT_TRUE(execute(sequence(watch(task("fail:0.1"), slow), task("D:0.1"))).is_done());
  EXPECT_EQ(trace()[2], "0.4 START D@a1");
}

TEST_F(ExecutionTest, InnerWatchIsAskedFirst) {
  EXPECT_TRUE(execute(watched(watched(task("fail:0.1"), Verdict::propagate), Verdict::ignore)).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START fail@a1", "0.1 ERROR fail@a1 boom", "E boom", "E boom"}));
}

TEST_F(ExecutionTest, GuardStopsTheRunningPartOfASequence) {  // case 42
  bool posted = false;
  auto const guarded = until(sequence(task("A:0.2"), task("B:5")), when([&] { return posted; }));
  EXPECT_TRUE(execute(concurrent(guarded, sequence(idle(seconds(0.5)), doing([&] { posted = true; })))).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.2 DONE A@a1", "0.2 START B@a1", "0.6 STOP B@a1"}));
}

TEST_F(ExecutionTest, GuardThatHoldsFromTheOutsetStartsNothing) {  // case 43
  EXPECT_TRUE(execute(until(task("A:5"), always())).is_done());
  EXPECT_TRUE(trace().empty());
}

TEST_F(ExecutionTest, GuardIsTestedOnceATick) {
  int tests = 0;
  EXPECT_TRUE(execute(until(task("A:5"), when([&] { return ++tests > 4; }))).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.4 STOP A@a1"}));
}

TEST_F(ExecutionTest, TaskThatEndsByItselfUnderAGuardIsNotStopped) {
  EXPECT_TRUE(execute(until(task("A:0.2"), never())).is_done());
  EXPECT_EQ(trace().back(), "0.2 DONE A@a1");
}

TEST_F(ExecutionTest, DuringStopsWhenTimeIsUp) {  // cases 45 and 46
  EXPECT_TRUE(execute(during(task("A:5"), seconds(0.3))).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.3 STOP A@a1"}));
}

TEST_F(ExecutionTest, DuringEndsWithItsBodyOrDoesNotBegin) {
  EXPECT_TRUE(execute(sequence(during(task("A:0.1"), seconds(9)), during(task("B:1"), seconds(0)))).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.1 DONE A@a1"}));
}

TEST_F(ExecutionTest, DuringEndsATaskThatNeverEnds) {
  EXPECT_TRUE(execute(during(idle(std::nullopt), seconds(2))).is_done());
  EXPECT_DOUBLE_EQ(stage.now_s(), 2.1);
}

TEST_F(ExecutionTest, AllOfRunsEachBranchWhenItsGuardHolds) {  // case 48
  bool posted = false;
  auto const tree = all_of({{when([&] { return posted; }), task("A:0.1")}, {always(), doing([&] { posted = true; })}});
  EXPECT_TRUE(execute(tree).is_done());
  EXPECT_EQ(trace(), (Trace{"0.1 START A@a1", "0.2 DONE A@a1"}));
}

TEST_F(ExecutionTest, AllOfRunsTheSameTaskTwiceOneAtATime) {  // case 49
  auto const twice = task("A:0.1");
  EXPECT_TRUE(execute(all_of({{always(), twice}, {always(), twice}})).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.1 DONE A@a1", "0.2 START A@a1", "0.3 DONE A@a1"}));
}

TEST_F(ExecutionTest, AllOfEndsWithTheFirstErrorAndOfNothingAtOnce) {
  EXPECT_FALSE(execute(all_of({{always(), task("fail:0.1")}, {always(), task("A:1")}})).is_done());
  EXPECT_EQ(trace().back(), "0.1 ERROR fail@a1 boom");
  EXPECT_TRUE(execute(all_of({})).is_done());
}

TEST(OneOf, RefusesToBeEmpty) {  // case 50
  auto const tree = one_of({});
  ASSERT_FALSE(tree.has_value());
  EXPECT_EQ(tree.error().message, "No choices were defined!");
}

TEST_F(ExecutionTest, ChoiceBecomesTheFirstBranchWhoseGuardHolds) {  // case 61
  auto const tree = *one_of({{never(), idle(seconds(0))}, {always(), task("B:0.1")}, {always(), task("C:0.1")}});
  EXPECT_TRUE(execute(tree).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START B@a1", "0.1 DONE B@a1"}));
}

TEST_F(ExecutionTest, ChoiceTestsNoGuardOnceItHasChosen) {
  int tests = 0;
  auto const counted = when([&] { return ++tests > 2; });
  EXPECT_TRUE(execute(wait_for(counted, task("A:0.5"))).is_done());
  EXPECT_EQ(tests, 3);
  EXPECT_EQ(trace(), (Trace{"0.2 START A@a1", "0.7 DONE A@a1"}));
}

TEST_F(ExecutionTest, StoppedChoiceTestsNoGuardsAndStopsNothing) {
  int tests = 0;
  auto const waiting = wait_for(when([&] { return ++tests > 100; }), task("A:1"));
  EXPECT_TRUE(execute(during(waiting, seconds(0.3))).is_done());
  EXPECT_EQ(tests, 3);
  EXPECT_TRUE(trace().empty());
}

TEST_F(ExecutionTest, SameTaskValueRunsOnTheVehicleOfEachOccurrence) {  // case 51
  auto const home = task("R:0.3");
  auto const tree = concurrent(restricted(sequence(task("A:0.2"), home), {{"a1"}}),
                               restricted(sequence(task("B:0.4"), home), {{"a2"}}));
  EXPECT_TRUE(execute(tree).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.0 START B@a2", "0.2 DONE A@a1", "0.2 START R@a1", "0.4 DONE B@a2",
                            "0.4 START R@a2", "0.5 DONE R@a1", "0.7 DONE R@a2"}));
}

TEST_F(ExecutionTest, ConditionIsTestedOnceATick) {  // case 55
  int n = 0;
  EXPECT_TRUE(execute(condition(when([&] { return ++n > 5; }))).is_done());
  EXPECT_EQ(n, 6);
  EXPECT_DOUBLE_EQ(stage.now_s(), 0.6);
}

TEST_F(ExecutionTest, ActionRunsOnceWithoutVehicles) {  // case 56
  int runs = 0;
  EXPECT_TRUE(stage.execute(doing([&] { ++runs; }), {}).is_done());
  EXPECT_EQ(runs, 1);
}

TEST_F(ExecutionTest, ExceptionStopsTheTreeBeforeItComesOut) {  // case 57
  auto const outcome = execute(concurrent(throwing(thrown("oops")), task("Z:2")));
  EXPECT_EQ(trace(), (Trace{"0.0 START Z@a1", "0.0 STOP Z@a1"}));
  EXPECT_EQ(outcome.failure->kind, FailureKind::exception);
  EXPECT_EQ(outcome.failure->message, "oops");
}

TEST_F(ExecutionTest, ExceptionTakesTheTurnOfTheSiblingsToTheRight) {
  bool has_run = false;
  EXPECT_FALSE(execute(concurrent(throwing(thrown("oops")), doing([&] { has_run = true; }))).is_done());
  EXPECT_FALSE(has_run);
}

TEST_F(ExecutionTest, ExceptionOfAGuardStopsWhatItGuards) {
  int tests = 0;
  auto const guard = when([&]() -> std::expected<bool, Failure> {
    if (++tests > 2) return std::unexpected(thrown("bad guard"));
    return false;
  });
  EXPECT_EQ(execute(until(task("A:5"), guard)).failure->message, "bad guard");
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.2 STOP A@a1"}));
}

TEST_F(ExecutionTest, ExceptionOfAGuardAtTheStartStopsSiblings) {
  auto const bad = when([]() -> std::expected<bool, Failure> { return std::unexpected(thrown("bad guard")); });
  EXPECT_EQ(execute(concurrent(task("A:5"), until(task("B:5"), bad))).failure->message, "bad guard");
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.0 STOP A@a1"}));
  EXPECT_FALSE(execute(condition(bad)).is_done());
  EXPECT_FALSE(execute(wait_for(bad, idle(seconds(1)))).is_done());
  EXPECT_FALSE(execute(all_of({{bad, idle(seconds(1))}})).is_done());
}

TEST_F(ExecutionTest, WatchedExceptionIsATaskErrorWithItsPayload) {
  auto failure = thrown("oops");
  failure.payload = std::make_shared<int>(7);
  auto const outcome = execute(watched(concurrent(throwing(failure), task("Z:2")), Verdict::propagate));
  EXPECT_EQ(trace(), (Trace{"0.0 START Z@a1", "0.0 STOP Z@a1", "E oops"}));
  EXPECT_EQ(outcome.failure->kind, FailureKind::task);
  EXPECT_EQ(outcome.failure->payload, failure.payload);
}

TEST_F(ExecutionTest, ExceptionOfAHandlerIsOneItself) {
  auto const handler = procedure(
      {.run = [](auto const&) -> std::expected<Verdict, Failure> { return std::unexpected(thrown("worse")); }});
  auto const outcome = execute(concurrent(watch(task("fail:0.1"), handler), task("Z:2")));
  EXPECT_EQ(outcome.failure->kind, FailureKind::exception);
  EXPECT_EQ(outcome.failure->message, "worse");
  EXPECT_EQ(trace().back(), "0.1 STOP Z@a2");
}

TEST_F(ExecutionTest, NoWatchStopsAHalt) {
  auto const outcome = execute(watched(concurrent(throwing(halted("enough")), task("Z:2")), Verdict::ignore));
  EXPECT_EQ(outcome.failure->kind, FailureKind::halt);
  EXPECT_EQ(trace(), (Trace{"0.0 START Z@a1", "0.0 STOP Z@a1"}));
}

TEST_F(ExecutionTest, HaltToTheRightOutweighsAnErrorOfTheSameTick) {
  auto const late = sequence(idle(seconds(0.2)), throwing(halted("enough")));
  EXPECT_EQ(execute(concurrent(task("fail:0.2"), late)).failure->kind, FailureKind::halt);
}

TEST_F(ExecutionTest, SuspendedActionHoldsUpNobodyAndIsCancelledByAStop) {
  int cancelled = 0;
  auto const slow =
      action(procedure({.run = [](auto const&) { return std::expected<Verdict, Failure>(Verdict::ignore); },
                        .returns_in_step = 100,
                        .cancelled = &cancelled}));
  EXPECT_TRUE(execute(concurrent(during(slow, seconds(0.3)), task("A:0.1"))).is_done());
  EXPECT_EQ(cancelled, 1);
  EXPECT_EQ(trace().back(), "0.1 DONE A@a1");
}

TEST_F(ExecutionTest, SignalsReachLaterPartsInTheSameTick) {  // case 67
  int ready = 0;
  auto const post = [&](int value) { return doing([&ready, value] { ready = value; }); };
  auto const consume = [&](int value) { return when([&ready, value] { return ready == value && (ready = 0, true); }); };
  auto const tree =
      concurrent(concurrent(restricted(sequence(task("S1:0.6"), post(1)), {{"a1"}}),
                            restricted(sequence(task("S2:0.2"), post(2)), {{"a2"}})),
                 restricted(all_of({{consume(1), task("R1:0.1")}, {consume(2), task("R2:0.1")}}), {{"u1"}}));
  EXPECT_TRUE(stage.execute(tree, {"a1", "a2", "u1"}).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START S1@a1", "0.0 START S2@a2", "0.2 DONE S2@a2", "0.2 START R2@u1", "0.3 DONE R2@u1",
                            "0.6 DONE S1@a1", "0.6 START R1@u1", "0.7 DONE R1@u1"}));
}

TEST_F(ExecutionTest, LostVehicleFailsTheTaskThatWouldStart) {
  auto silent = *stage.platform.find({"a1"});
  silent.connected = false;
  auto const lose = doing([&] { stage.platform.set_vehicle(silent); });
  EXPECT_EQ(execute(sequence(lose, task("A:1"))).failure->message, "vehicle a1 is lost");
}

TEST_F(ExecutionTest, RunsTreesAsDeepAsAllowed) {
  auto tree = task("A:0.2");
  while (tree->depth < max_task_depth) tree = until(tree, never());
  EXPECT_TRUE(execute(tree).is_done());
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.2 DONE A@a1"}));
}

TEST_F(ExecutionTest, RunsAThousandTasksAtOnce) {
  std::vector<std::string> ids;
  auto vehicle = *stage.platform.find({"a1"});
  auto tree = idle(seconds(0));
  for (int i = 0; i < 1000; ++i) {
    ids.push_back(fmt::format("v{}", i));
    vehicle.id = {ids.back()};
    stage.platform.set_vehicle(vehicle);
    tree = concurrent(tree, sequence(task("A:0.1"), task("B:0.1")));
  }
  EXPECT_TRUE(stage.execute(tree, ids).is_done());
  EXPECT_EQ(trace().size(), 4000u);
  EXPECT_EQ(trace().back(), "0.2 DONE B@v999");
}

// ---- from outside

struct DrivenExecutionTest : ExecutionTest {
  void begin(TaskTree const& tree) {
    execution.emplace(tree, *allocate(tree, stage.pick({"a1", "a2"})), stage.platform, stage.observer());
    execution->start(stage.loop.now());
  }
  std::optional<Execution> execution;
};

TEST_F(DrivenExecutionTest, StopEndsWhatRunsOnce) {
  begin(sequence(concurrent(task("A:5"), task("B:5")), task("C:5")));
  EXPECT_FALSE(execution->step(stage.loop.now()));
  execution->stop(stage.loop.now());
  execution->stop(stage.loop.now());
  EXPECT_TRUE(execution->step(stage.loop.now()));
  EXPECT_TRUE(execution->outcome()->is_stopped);
  EXPECT_FALSE(execution->outcome()->is_done());
  execution.reset();
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.0 START B@a2", "0.0 STOP A@a1", "0.0 STOP B@a2"}));
}

TEST_F(DrivenExecutionTest, DestroyingItStopsWhatRuns) {
  begin(task("A:5"));
  execution.reset();
  EXPECT_EQ(trace().back(), "0.0 STOP A@a1");
}

TEST_F(DrivenExecutionTest, ReleasedVehicleIsStoppedAndItsTasksFail) {
  auto const withdraw = doing([&] { execution->withdraw({"a1"}); });
  begin(concurrent(watched(restricted(task("A:5"), {{"a1"}}), Verdict::ignore),
                   sequence(withdraw, restricted(task("B:5"), {{"a2"}}))));
  EXPECT_FALSE(execution->step(stage.loop.now()));
  EXPECT_FALSE(execution->step(stage.loop.now()));
  EXPECT_EQ(trace(), (Trace{"0.0 START A@a1", "0.0 STOP A@a1", "0.0 START B@a2", "E vehicle a1 was released"}));
}

TEST_F(DrivenExecutionTest, NothingStartsOnAReleasedVehicle) {
  begin(sequence(doing([&] { execution->withdraw({"a1"}); }), task("A:5")));
  EXPECT_TRUE(execution->step(stage.loop.now()));
  EXPECT_EQ(trace(), (Trace{"0.0 ERROR A@a1 vehicle a1 was released"}));
}

TEST_F(DrivenExecutionTest, RunEndsWhenItIsStoppedFromOutside) {
  begin(idle(std::nullopt));
  base::Task<Outcome> running = run(stage.loop, *execution);
  stage.loop.post([&] { execution->stop(stage.loop.now()); });
  EXPECT_TRUE(stage.loop.run_until_done(std::move(running)).is_stopped);
}

TEST_F(DrivenExecutionTest, ReportsEveryAllocationBeforeAnyStart) {
  std::vector<std::string> kinds;
  auto const tree = concurrent(task("A:5"), restricted(task("B:5"), {{"a1"}}));
  Execution reporting(tree, *allocate(tree, stage.pick({"a1", "a2"})), stage.platform, [&](TaskEvent const& event) {
    kinds.push_back(fmt::format("{} {}@{}", to_string(event.kind), event.subject->name(), event.vehicle->text));
  });
  reporting.start(stage.loop.now());
  EXPECT_EQ(kinds, (Trace{"ALLOC B@a1", "ALLOC A@a2", "START A@a2", "START B@a1"}));
}

TEST_F(DrivenExecutionTest, ViewShowsTheTreeAndWhatRuns) {
  auto const tree =
      sequence(task("A:0.1"), concurrent(task("B:5"), wait_for(never(), task("C:1")), {.line = 7, .label = "pair"}));
  begin(tree);
  execution->step(stage.loop.now());
  stage.loop.run_until_done([](base::Loop& loop) -> base::Task<int> {
    co_await loop.sleep(seconds(0.1));
    co_return 0;
  }(stage.loop));
  execution->step(stage.loop.now());
  auto const view = execution->view();
  EXPECT_EQ(view.kind, "sequence");
  EXPECT_EQ(view.label, "A >> B | <choice>");
  EXPECT_EQ(view.children[0].state, TaskState::done);
  auto const& pair = view.children[1];
  EXPECT_EQ(pair.label, "pair");
  EXPECT_EQ(pair.line, 7);
  EXPECT_EQ(pair.children[0].state, TaskState::running);
  EXPECT_EQ(pair.children[0].vehicle, VehicleId{"a1"});
  EXPECT_EQ(pair.children[0].detail, "0.0/5.0 s");
  EXPECT_EQ(pair.children[1].kind, "waitFor");
  EXPECT_EQ(pair.children[1].children[0].state, TaskState::waiting);
  EXPECT_EQ(pair.children[1].children[0].id, 5);
}

// ---- names

TEST_F(ExecutionTest, TasksPrintAsInTheOriginal) {
  EXPECT_EQ(name(sequence(sequence(task("A:1"), task("B:1")), task("C:1"))), "A >> B >> C");
  EXPECT_EQ(name(concurrent(until(task("A:1"), never()), restricted(task("B:1"), {}))), "A | B");
  EXPECT_EQ(name(watch(during(task("A:1"), seconds(1)), procedure({}))), "watcher<A>");
  EXPECT_EQ(name(idle(seconds(0.5))), "idle(0.500000)");
  EXPECT_EQ(name(sequence(doing([] {}), condition(always()))), "<action> >> <condition>");
  EXPECT_EQ(name(concurrent(all_of({}), wait_for(always(), task("A:1")))), "<allOf> | <choice>");
}

}  // namespace
}  // namespace lapwing::tasks
