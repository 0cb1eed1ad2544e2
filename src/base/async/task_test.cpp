#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/async/mailbox.hpp"
#include "base/async/scope.hpp"

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

Loop::Pace constexpr unpaced{.speedup = 1.0, .unpaced = true};

Task<int> answer_after(Loop& loop, Duration delay) {
  co_await loop.sleep(delay);
  co_return 42;
}

TEST(Loop, UnpacedTimeJumpsToTheNextTimer) {
  Loop loop(unpaced);
  EXPECT_EQ(loop.run_until_done(answer_after(loop, 10h)), 42);
  EXPECT_EQ(loop.now().time_since_epoch(), 10h);
}

TEST(Loop, SpeedupScalesTheWall) {
  Loop loop(Loop::Pace{.speedup = 1000.0});
  auto const before = std::chrono::steady_clock::now();
  loop.run_until_done(answer_after(loop, 10s));
  EXPECT_LT(std::chrono::steady_clock::now() - before, 5s);
  EXPECT_GE(loop.now().time_since_epoch(), 10s);
}

TEST(Loop, GivesTimersTheirTurnBesideAnEventThatAlwaysComes) {
  Loop loop;
  // As a socket in a flood: whenever it was served, it is ready again.
  struct Flood {
    Loop& loop;
    void serve() {
      loop.post_from_other_thread([this] { serve(); });
    }
  } flood{loop};
  flood.serve();
  EXPECT_EQ(loop.run_until_done(answer_after(loop, 5ms)), 42);
}

/// Keeps the processor busy for so long by the wall's clock.
void work_for(std::chrono::steady_clock::duration duration) {
  auto const end = std::chrono::steady_clock::now() + duration;
  while (std::chrono::steady_clock::now() < end) {
  }
}

/// As a simulation whose steps take longer than the time that they simulate: it is late for each.
Task<> step_late(Loop& loop, int& steps) {
  for (auto next = loop.now();; next += 1ms) {
    co_await loop.sleep_until(next);
    work_for(100us);
    ++steps;
  }
}

TEST(Loop, GivesEventsTheirTurnBesideTimersThatAreAlwaysLate) {
  Loop loop(Loop::Pace{.speedup = 1000.0});
  Scope scope(loop);
  int steps = 0;
  scope.spawn(step_late(loop, steps));
  // As a signal that waits behind what many sockets have to say.
  struct Events {
    Loop& loop;
    int left;
    void serve() {
      if (--left == 0) return loop.stop();
      loop.post_from_other_thread([this] { serve(); });
    }
  } events{loop, 1000};
  events.serve();
  loop.run();
  EXPECT_LT(steps, 200) << "they had a fair share of the time";
}

TEST(Loop, TimeThatWaitsIsNeverLateForATimer) {
  Loop loop(Loop::Pace{.speedup = 1000.0});
  auto latest = Duration::zero();
  auto simulate = [&]() -> Task<> {
    auto next = loop.now();
    for (int step = 0; step < 100; ++step, next += 50ms) {
      co_await loop.sleep_until(next);
      latest = std::max(latest, loop.now() - next);
      work_for(1ms);  // 1 s of the loop's time
    }
  };
  loop.run_until_done(simulate());
  EXPECT_LT(latest, 500ms) << "as late as time that does not wait";
}

TEST(Loop, TimeThatWaitsDoesSoForEvents) {
  Loop loop(Loop::Pace{.speedup = 1000.0});
  Scope scope(loop);
  int steps = 0;
  scope.spawn(step_late(loop, steps));
  struct Events {
    Loop& loop;
    int left = 0;
    void serve() {
      if (--left > 0) loop.post_from_other_thread([this] { serve(); });
    }
  } events{loop};
  auto simulate = [&]() -> Task<> {
    for (int round = 0; round < 10; ++round) {
      events.left = 500;
      events.serve();
      co_await loop.sleep(50ms);
      EXPECT_EQ(events.left, 0) << "of what arrived 50 ms ago";
    }
  };
  loop.run_until_done(simulate());
}

TEST(Loop, TimeThatWaitsKeepsItsPaceWhereTheMachineDoes) {
  Loop loop(Loop::Pace{.speedup = 1000.0});
  auto const before = std::chrono::steady_clock::now();
  loop.run_until_done(answer_after(loop, 10s));
  auto const took = std::chrono::steady_clock::now() - before;
  EXPECT_GE(took, 9ms);
  EXPECT_LT(took, 5s);
  EXPECT_GE(loop.now().time_since_epoch(), 10s);
}

TEST(Loop, TimersFireInOrderOfDeadlineThenOfCall) {
  Loop loop(unpaced);
  std::vector<std::string> order;
  Scope scope(loop);
  auto say = [&](std::string name, Duration delay) -> Task<void> {
    co_await loop.sleep(delay);
    order.push_back(name);
  };
  scope.spawn(say("late", 2s));
  scope.spawn(say("first", 1s));
  scope.spawn(say("second", 1s));
  loop.run_until_done(answer_after(loop, 3s));
  EXPECT_EQ(order, (std::vector<std::string>{"first", "second", "late"}));
}

TEST(Task, AwaitingOneThatEndsAtOnceManyTimesDoesNotGrowTheStack) {
  Loop loop(unpaced);
  auto one = []() -> Task<int> { co_return 1; };
  auto many = [&]() -> Task<int> {
    int sum = 0;
    for (int i = 0; i < 200'000; ++i) sum += co_await one();
    co_return sum;
  };
  EXPECT_EQ(loop.run_until_done(many()), 200'000);
}

TEST(Mailbox, ReceiveTimesOutAndLosesNothingAfterwards) {
  Loop loop(unpaced);
  Mailbox<int> box(loop, 2);
  auto exchange = [&]() -> Task<int> {
    auto const nothing = co_await box.receive(10ms);
    EXPECT_EQ(nothing.error(), ReceiveError::timed_out);
    EXPECT_TRUE(box.post(7));
    auto const got = co_await box.receive(10ms);
    co_return *got;
  };
  EXPECT_EQ(loop.run_until_done(exchange()), 7);
}

TEST(Mailbox, RefusesWhenFullAndDeliversWhatWasPostedBeforeClosing) {
  Loop loop(unpaced);
  Mailbox<int> box(loop, 1);
  EXPECT_TRUE(box.post(1));
  EXPECT_FALSE(box.post(2));
  box.close();
  auto drain = [&]() -> Task<std::vector<int>> {
    std::vector<int> all;
    for (;;) {
      auto const got = co_await box.receive(1s);
      if (!got) break;
      all.push_back(*got);
    }
    co_return all;
  };
  EXPECT_EQ(loop.run_until_done(drain()), std::vector<int>{1});
}

TEST(Mailbox, ReceiverDestroyedWhileWaitingIsNeverWoken) {
  Loop loop(unpaced);
  Mailbox<int> box(loop, 4);
  {
    Scope scope(loop);
    auto waiting = [&]() -> Task<void> { (void)co_await box.receive(1h); };
    scope.spawn(waiting());
  }
  EXPECT_TRUE(box.post(1));
  loop.run_until_done(answer_after(loop, 2h));
  EXPECT_EQ(box.size(), 1u);
}

TEST(Notifier, WaitForLooksAtTheConditionAfterEachNotification) {
  Loop loop(unpaced);
  Notifier changed(loop);
  int value = 0;
  Scope scope(loop);
  auto counting = [&]() -> Task<void> {
    for (int i = 0; i < 5; ++i) {
      co_await loop.sleep(1s);
      ++value;
      changed.notify_all();
    }
  };
  scope.spawn(counting());
  EXPECT_TRUE(loop.run_until_done(changed.wait_for([&] { return value == 3; }, 1h)));
  EXPECT_EQ(loop.now().time_since_epoch(), 3s);
  EXPECT_FALSE(loop.run_until_done(changed.wait_for([&] { return value == 9; }, 1min)));
}

}  // namespace
}  // namespace lapwing::base
