#include "base/async/scope.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

Loop::Pace constexpr unpaced{.speedup = 1.0, .unpaced = true};

Task<> pass(Loop& loop, Duration time) {
  co_await loop.sleep(time);
}

TEST(Scope, DestroyingItCancelsWhatStillRunsAndRunsDestructors) {
  Loop loop(unpaced);
  bool ended = false;
  bool destroyed = false;
  struct Guard {
    bool& flag;
    ~Guard() { flag = true; }
  };
  {
    Scope scope(loop);
    auto sleeper = [&]() -> Task<void> {
      Guard guard{destroyed};
      co_await loop.sleep(1h);
      ended = true;
    };
    scope.spawn(sleeper());
    loop.run_until_done(pass(loop, 1s));
    EXPECT_EQ(scope.size(), 1u);
  }
  EXPECT_TRUE(destroyed);
  loop.run_until_done(pass(loop, 2h));
  EXPECT_FALSE(ended);
}

TEST(Scope, ForgetsTasksThatHaveEnded) {
  Loop loop(unpaced);
  Scope scope(loop);
  auto brief = [&]() -> Task<void> { co_await loop.turn(); };
  for (int i = 0; i < 100; ++i) scope.spawn(brief());
  loop.run_until_done(pass(loop, 1s));
  EXPECT_TRUE(scope.empty());
}

TEST(Scope, ForgetsOneThatHasEndedWhenItIsClearedInTheSameTurn) {
  Loop loop(unpaced);
  Scope scope(loop);
  Notifier go(loop);
  auto brief = [&]() -> Task<void> { co_await go.wait(); };
  scope.spawn(brief());
  loop.post([&] { go.notify_all(); });
  // Behind the one that ends: it waits to be buried when the scope is cleared.
  auto clear = [&]() -> Task<void> {
    co_await go.wait();
    scope.clear();
    scope.spawn(pass(loop, 1h));
  };
  loop.run_until_done(clear());
  loop.run_until_done(pass(loop, 1s));
  EXPECT_EQ(scope.size(), 1u) << "that which was spawned afterwards";
}

TEST(Scope, JoinWaitsForAllThatRuns) {
  Loop loop(unpaced);
  Scope scope(loop);
  scope.spawn(pass(loop, 3s));
  scope.spawn(pass(loop, 5s));
  loop.run_until_done(scope.join());
  EXPECT_TRUE(scope.empty());
  EXPECT_EQ(loop.now().time_since_epoch(), 5s) << "at once, and not when somebody looks again";
}

TEST(Scope, JoinWaitsForWhatIsSpawnedMeanwhile) {
  Loop loop(unpaced);
  Scope scope(loop);
  auto spawn_another = [&]() -> Task<void> {
    co_await loop.sleep(3s);
    scope.spawn(pass(loop, 4s));
  };
  scope.spawn(spawn_another());
  loop.run_until_done(scope.join());
  EXPECT_EQ(loop.now().time_since_epoch(), 7s);
}

TEST(Scope, JoinEndsAtOnceWhenNothingRuns) {
  Loop loop(unpaced);
  Scope scope(loop);
  loop.run_until_done(scope.join());
  EXPECT_TRUE(loop.run_until_done(scope.join_until(loop.now())));
}

TEST(Scope, JoinEndsWhenAllIsCancelled) {
  Loop loop(unpaced);
  Scope scope(loop);
  scope.spawn(pass(loop, 1h));
  auto cancel = [&]() -> Task<void> {
    co_await loop.sleep(2s);
    scope.clear();
  };
  Scope other(loop);
  other.spawn(cancel());
  loop.run_until_done(scope.join());
  EXPECT_EQ(loop.now().time_since_epoch(), 2s);
}

TEST(Scope, JoinUntilGivesUpAtItsDeadlineAndLeavesTheTasks) {
  Loop loop(unpaced);
  Scope scope(loop);
  scope.spawn(pass(loop, 10s));
  EXPECT_FALSE(loop.run_until_done(scope.join_until(loop.now() + 4s)));
  EXPECT_EQ(loop.now().time_since_epoch(), 4s);
  EXPECT_TRUE(loop.run_until_done(scope.join_until(loop.now() + 7s)));
  EXPECT_EQ(loop.now().time_since_epoch(), 10s);
}

TEST(Scope, SeveralMayJoin) {
  Loop loop(unpaced);
  Scope scope(loop);
  scope.spawn(pass(loop, 1s));
  int joined = 0;
  auto wait = [&]() -> Task<void> {
    co_await scope.join();
    ++joined;
  };
  Scope others(loop);
  others.spawn(wait());
  others.spawn(wait());
  loop.run_until_done(others.join());
  EXPECT_EQ(joined, 2);
}

}  // namespace
}  // namespace lapwing::base
