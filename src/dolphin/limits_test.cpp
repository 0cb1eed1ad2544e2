#include <gtest/gtest.h>

#include "dolphin/testing.hpp"

/// Scripts that use too much end with an exception, and never hold up the loop.
namespace lapwing::dolphin {
namespace {

using testing::Bench;
using testing::printed;

TEST(Limits, EndlessRecursionIsAnException) {
  EXPECT_EQ(printed("def f(n) { f(n + 1) }\ntry { f(0) } catch (StackOverflowError e) { print 'deep' }"), "deep");
  EXPECT_EQ(printed("def f(n) { n == 0 ? 0 : 1 + f(n - 1) }\nprint f(5000)"), "5000");
}

TEST(Limits, TooMuchMemoryIsAnException) {
  Bench bench;
  bench.options.limits.heap_bytes = std::size_t{1} << 20U;
  EXPECT_EQ(bench.run("l = []\nwhile (true) { l << 'x' * 1 }").substr(0, 6), "exit 1");
  Bench other;
  other.options.limits.heap_bytes = std::size_t{1} << 20U;
  EXPECT_NE(other.run("l = []\nwhile (true) { l << [1] }").find("OutOfMemoryError"), std::string::npos);
}

TEST(Limits, EndlessLoopLeavesTheLoopResponsive) {
  Bench bench;
  auto const source = std::make_shared<base::SourceFile const>("loop.dolphin", "while (true) { }");
  base::Diagnostics diagnostics(*source);
  auto const program = load(source, bench.platform.builders(), diagnostics);
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

TEST(Limits, ListsThatHoldThemselvesPrintAndEnd) {
  EXPECT_NE(printed("l = []\nl << l\nprint l").find("…"), std::string::npos);
  EXPECT_EQ(printed("l = []\nfor (i in 1..200000) { l = [l] }\nprint 'built'\nl = null"), "built");
}

}  // namespace
}  // namespace lapwing::dolphin
