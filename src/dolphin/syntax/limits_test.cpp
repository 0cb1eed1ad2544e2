#include "dolphin/syntax/limits.hpp"

#include <gtest/gtest.h>

#include "dolphin/testing/script_bench.hpp"

/// Scripts that use too much end with an exception, and never hold up the loop.
namespace lapwing::dolphin {
namespace {

using testing::Bench;
using testing::printed;

/// What the script prints of the exception that `code` throws.
std::string thrown_by(std::string const& code) {
  auto text = printed("try { " + code + " } catch (Throwable e) { print e }");
  return text.substr(0, text.find(':'));
}

/// How the script ends that has a mebibyte.
std::string run_in_little_memory(std::string const& script) {
  Bench bench;
  bench.options.limits.heap_bytes = std::size_t{1} << 20U;
  return bench.run(script);
}

TEST(Limits, EndlessRecursionIsAnException) {
  EXPECT_EQ(printed("def f(n) { f(n + 1) }\ntry { f(0) } catch (StackOverflowError e) { print 'deep' }"), "deep");
  EXPECT_EQ(printed("def f(n) { n == 0 ? 0 : 1 + f(n - 1) }\nprint f(5000)"), "5000");
  EXPECT_EQ(printed("def f = null\nf = { n -> f(n + 1) }\ntry { f(0) } catch (StackOverflowError e) { print 'deep' }"),
            "deep");
}

TEST(Limits, CallsWithManyVariablesAreAnException) {
  std::string variables;
  for (int i = 0; i < 500; ++i) variables += fmt::format("def v{} = {}\n", i, i);
  auto const script = "def f(n) {\n" + variables + "f(n + 1) }\ntry { f(0) } catch (StackOverflowError e) { print e }";
  EXPECT_EQ(printed(script), "StackOverflowError: calls under way hold more than 1000000 values");
}

TEST(Limits, TooMuchMemoryIsAnException) {
  EXPECT_EQ(run_in_little_memory("l = []\nwhile (true) { l << 'x' * 1 }").substr(0, 6), "exit 1");
  EXPECT_NE(run_in_little_memory("l = []\nwhile (true) { l << [1] }").find("OutOfMemoryError"), std::string::npos);
}

TEST(Limits, EverythingThatGrowsEnds) {
  for (auto const* growth : {"l = [1]\nwhile (true) { l = l + l }", "l = [1]\nwhile (true) { l.addAll(l) }",
                             "m = [:]\nfor (i in 1..9000000) { m[i] = i }", "l = []\nwhile (true) { l << { l } }",
                             "l = []\nwhile (true) { l << idle(1) }", "l = []\nwhile (true) { k = []\nk << k }"}) {
    EXPECT_NE(run_in_little_memory(growth).find("OutOfMemoryError"), std::string::npos) << growth;
  }
}

TEST(Limits, WhatIsTakenAwayGivesItsMemoryBack) {
  for (auto const* use : {"m = [:]\nfor (i in 1..100000) {\nm[i] = i\nm.remove(i)\n}",
                          "l = []\nfor (i in 1..100000) {\nl << i\nl.pop()\n}",
                          "l = []\nfor (i in 1..1000) {\nfor (k in 1..100) { l << k }\nl.clear()\n}",
                          "for (i in 1..100000) {\npost s: i\nconsume s: i\n}"}) {
    EXPECT_EQ(run_in_little_memory(use).substr(0, 6), "exit 0") << use;
  }
}

TEST(Limits, LongTextsAreAnException) {
  EXPECT_EQ(thrown_by("s = 'ab'\nwhile (true) { s += s }"), "OutOfMemoryError");
  EXPECT_EQ(thrown_by("s = 'ab'\nwhile (true) { s = \"$s$s$s\" }"), "OutOfMemoryError");
  std::string const half = "s = 'a'\nfor (i in 1..19) { s += s }\n";
  EXPECT_EQ(printed(half + "print s.length()"), "524288");
  EXPECT_EQ(thrown_by(half + "s.replace('a', s)"), "OutOfMemoryError");
  EXPECT_EQ(thrown_by(half + "(1..1000000).join(s)"), "OutOfMemoryError");
  EXPECT_EQ(printed(half + "print s.toList().size()"), "524288");
}

TEST(Limits, SearchingLongTextsIsQuick) {
  std::string const texts = "s = 'a'\nfor (i in 1..19) { s += s }\nwanted = s.substring(0, 262144) + 'b'\n";
  EXPECT_EQ(printed(texts + "print s.indexOf(wanted)"), "-1");
  EXPECT_EQ(printed(texts + "print s.contains(wanted)"), "false");
  EXPECT_EQ(printed(texts + "print wanted in s"), "false");
}

TEST(Limits, OperationsOnLongListsEndInTime) {
  std::string const lists = "a = (1..100000).collect { it + 0.5 }\nb = (200001..300000).collect { it + 0.5 }\n";
  EXPECT_EQ(thrown_by(lists + "a - b"), "OutOfMemoryError");
  EXPECT_EQ(thrown_by(lists + "a.unique()"), "OutOfMemoryError");
  EXPECT_EQ(printed("print((1..1000).collect { it / 8 }.unique().size())"), "1000");
  EXPECT_EQ(thrown_by(lists + "a.intersect(b)"), "OutOfMemoryError");
  EXPECT_EQ(thrown_by(lists + "a.removeAll(b)"), "OutOfMemoryError");
  EXPECT_EQ(printed("print([1, 2, 3, 2] - 2)\nprint([1, 2, 3] - [3, 1])"), "[1, 3][2]");
}

TEST(Limits, WholeNumbersAndTextsAreLookedUp) {
  EXPECT_EQ(printed("l = (1..100000).toList()\nprint((l - l).size())\nprint((l + l).unique().size())"), "0100000");
  EXPECT_EQ(printed("l = (1..50000).collect { \"v$it\" }\nprint l.intersect(l.reverse()).size()"), "50000");
  EXPECT_EQ(printed("print([1, 2.0, '1', 1.0, 2, true] - [2])\nprint([1, 1.0, '1', true, 2.0, 2].unique())"),
            "[1, 1, 1.0, true][1, 1, true, 2.0]");
}

TEST(Limits, SignalsThatNobodyConsumesAreAnException) {
  EXPECT_EQ(thrown_by("for (i in 1..20000) { post s: i }"), "OutOfMemoryError");
  EXPECT_EQ(thrown_by("for (i in 1..20000) { m = [:]\nm[\"s$i\"] = 1\npost m }"), "OutOfMemoryError");
}

TEST(Limits, MissionsWithANameCountAsMemory) {
  auto const text = run_in_little_memory(
      "for (i in 1..100000) { mission {\nname \"m$i\"\nhome location(41, -8)\ntakeOff location(41, -8)\n} }");
  EXPECT_NE(text.find("OutOfMemoryError"), std::string::npos) << text;
}

TEST(Limits, EndlessLoopLeavesTheLoopResponsive) {
  Bench bench;
  auto const source = std::make_shared<base::SourceFile const>("loop.dolphin", "while (true) { }");
  base::Diagnostics diagnostics(*source);
  auto const program = load(source, bench.platform.vocabulary(), diagnostics);
  ASSERT_TRUE(program);
  Engine engine(bench.loop, bench.platform, bench.transcript, {});
  int turns = 0;
  std::function<void()> const watch = [&] {
    if (++turns == 10) return engine.stop();
    bench.loop.post(watch);
  };
  bench.loop.post(watch);
  auto const outcome = bench.loop.run_until_done(engine.run(program));
  EXPECT_EQ(exit_code(outcome), 130);
  EXPECT_EQ(turns, 10);
}

/// While a script computes, time goes on for everything else, in simulated time too.
TEST(Limits, TimePassesWhileAScriptComputes) {
  Bench bench;
  auto const source = std::make_shared<base::SourceFile const>("loop.dolphin", "while (true) { }");
  base::Diagnostics diagnostics(*source);
  auto const program = load(source, bench.platform.vocabulary(), diagnostics);
  ASSERT_TRUE(program);
  Engine engine(bench.loop, bench.platform, bench.transcript, {});
  base::Scope scope(bench.loop);
  auto const stop = [](base::Loop& loop, Engine& running) -> base::Task<void> {
    co_await loop.sleep(std::chrono::milliseconds(100));
    running.stop();
  };
  scope.spawn(stop(bench.loop, engine));
  auto const outcome = bench.loop.run_until_done(engine.run(program));
  EXPECT_EQ(exit_code(outcome), 130);
  EXPECT_LT(bench.loop.now().time_since_epoch(), std::chrono::milliseconds(200));
}

TEST(Limits, ComputingTakesTheSameTimeInEveryRun) {
  auto const run = [] {
    Bench bench;
    return bench.run("n = 0\n1000000.times { n += it }\nmessage System.nanoTime()");
  };
  EXPECT_EQ(run(), run());
}

TEST(Limits, StepsOfTheWholeRunMayBeLimited) {
  for (auto const* endless :
       {"while (true) { }", "while (true) { try { while (true) { } } finally { while (true) { } } }",
        "while (true) { try { while (true) { } } catch (Throwable e) { } }", "execute action { while (true) { } }",
        "execute condition { (1..1000).each { it }\nfalse }"}) {
    Bench bench;
    bench.options.limits.steps = 100'000;
    auto const text = bench.run(endless);
    EXPECT_NE(text.find("the script took more than 100000 steps"), std::string::npos) << endless << text;
    EXPECT_NE(text.find("exit 3"), std::string::npos) << endless << text;
  }
}

TEST(Limits, LoopThatNeverWaitsEndsTheScript) {
  for (auto const* endless : {"while (true) { }", "while (true) { try { while (true) { } } catch (Throwable e) { } }",
                              "v = pick { while (true) { } }", "execute action { while (true) { } }",
                              "def f() { while (true) { [1].each { it } } }\nf()"}) {
    Bench bench;
    bench.options.limits.busy_steps = 100'000;
    auto const text = bench.run(endless);
    EXPECT_NE(text.find("the script let no time pass for 100000 steps"), std::string::npos) << endless << text;
    EXPECT_NE(text.find("exit 3"), std::string::npos) << endless << text;
  }
}

TEST(Limits, WaitingStartsTheCountOfStepsAnew) {
  Bench bench;
  bench.options.limits.busy_steps = 100'000;
  auto const text = bench.run("for (i in 1..100) { 1000.times { x = it }\npause 1 }\nprint 'done'");
  EXPECT_NE(text.find("exit 0"), std::string::npos) << text;
}

TEST(Limits, LongLinesAreReadInTime) {
  std::string list = "x = [1";
  std::string closures = "def f(a) { a }\nx = f";
  for (int i = 0; i < 100'000; ++i) {
    list += ",1";
    closures += "{}";
  }
  EXPECT_EQ(printed(list + "]\nprint x.size()"), "100001");
  EXPECT_NE(printed(closures).find("f does not take 100000 arguments"), std::string::npos);
}

TEST(Limits, LocalsBeyondSixteenBitsKeepTheirPlaces) {
  std::string script = "x = 0\n";
  for (int i = 0; i < 40'000; ++i) script += "x++\n";
  EXPECT_EQ(printed(script + "for (i in 1..3) { print i }\ntry { print x } finally { print '.' }"), "12340000.");
}

TEST(Limits, GuardThatNeverReturnsIsAnError) {
  Bench bench;
  bench.options.limits.guard_budget = 10'000;
  EXPECT_NE(bench.run("execute condition { while (true) { } }").find("a guard took more than 10000 steps"),
            std::string::npos);
}

TEST(Limits, GuardMustNotWait) {
  EXPECT_NE(printed("execute condition { pause 1; true }").find("a guard must not wait, so it cannot use pause"),
            std::string::npos);
}

TEST(Limits, ManyTasksRunAtOnce) {
  EXPECT_EQ(printed("t = idle(0.3)\nfor (i in 1..1000) { t = t | (idle(0.5) >> action { n = (i == 1 ? 0 : n) + 1 }) "
                    "}\nexecute t\nprint n"),
            "1000");
}

TEST(Limits, TasksThatDoubleAreAnException) {
  EXPECT_EQ(thrown_by("t = idle(1)\nfor (i in 1..40) { t = t | t }"), "IllegalArgumentException");
  EXPECT_EQ(thrown_by("t = idle(1)\nfor (i in 1..40) { t = (t >> t) / { true } }"), "IllegalArgumentException");
  EXPECT_EQ(thrown_by("t = idle(1)\nfor (i in 1..2000) { t = t / { true } }"), "IllegalArgumentException");
  EXPECT_EQ(printed("t = idle(1)\nfor (i in 1..8) { t = (t >> t) | t }\nprint \"$t\".length() < 3000"), "true");
}

TEST(Limits, ListsThatHoldThemselvesPrintAndEnd) {
  EXPECT_NE(printed("l = []\nl << l\nprint l").find("…"), std::string::npos);
  EXPECT_EQ(printed("l = []\nfor (i in 1..200000) { l = [l] }\nprint 'built'\nl = null"), "built");
  EXPECT_LT(printed("l = [1]\nfor (i in 1..60) { l = [l, l] }\nprint l").size(), max_printed_size + 1000);
  EXPECT_LT(printed("m = [:]\nm.me = m\nprint m").size(), 1000U);
}

TEST(Limits, ListsThatHoldThemselvesCompareAndEnd) {
  EXPECT_EQ(printed("a = []\na << a\nb = []\nb << b\nprint a == b"), "true");
  EXPECT_EQ(printed("a = [1]\nb = [1]\nfor (i in 1..60) { a = [a, a]\nb = [b, b] }\nprint a == b"), "true");
  EXPECT_EQ(printed("a = []\na << a << 1\nb = []\nb << b << 2\nprint a == b"), "false");
  EXPECT_EQ(printed("l = []\nl << l\nm = [:]\nm[l] = 1\nprint m[l]"), "1");
  EXPECT_EQ(printed("m = [:]\nm[m] = m\nprint m.size()"), "1");
}

TEST(Limits, ListsOfAnyDepthAreComparedAndFlattened) {
  auto const nested = std::string("a = [7]\nb = [7]\nc = [8]\nfor (i in 1..100000) { a = [a]\nb = [b]\nc = [c] }\n");
  EXPECT_EQ(printed(nested + "print \"${a == b} ${a == c} ${a.flatten()}\""), "true false [7]");
  EXPECT_EQ(printed("a = 'x'\nb = (1..2000000).collect { a }\nprint b == (b + [])"), "true");
}

TEST(Limits, ListsThatHoldThemselvesHaveNoMembers) {
  EXPECT_EQ(thrown_by("l = []\nl << l\nl.km"), "RuntimeException");
  EXPECT_EQ(thrown_by("l = [1]\nfor (i in 1..30) { l = [l, l] }\nl.km"), "OutOfMemoryError");
  EXPECT_EQ(printed("print([1, [2, 3]].km)"), "[1000, [2000, 3000]]");
}

TEST(Limits, ListsThatHoldThemselvesAreFlattenedAndUsedAsIndexAndEnd) {
  EXPECT_EQ(thrown_by("l = []\nl << l\nl << l\nl.flatten()"), "OutOfMemoryError");
  EXPECT_EQ(thrown_by("l = []\nl << l\n'abc'[l]"), "IllegalArgumentException");
  EXPECT_EQ(thrown_by("r = 0..1000000000\nr[0..999999999]"), "OutOfMemoryError");
  EXPECT_EQ(printed("s = 'a' * 500000\nprint s[0..499999].length()\nn = 0\nfor (c in s) { n++ }\nprint n"),
            "500000500000");
  EXPECT_EQ(thrown_by("s = 'a' * 500000\ns.padLeft(10000000, s)"), "IllegalArgumentException");
}

TEST(Limits, NumbersTooLargeHaveNoNearestInteger) {
  EXPECT_EQ(thrown_by("print((1.0e300).round())"), "ArithmeticException");
  EXPECT_EQ(printed("print((2.5).round())\nprint((7).round())"), "37");
}

}  // namespace
}  // namespace lapwing::dolphin
