#include "base/async/pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/async/scope.hpp"
#include "base/error.hpp"

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

Loop::Pace constexpr unpaced{.speedup = 1.0, .unpaced = true};

/// Jobs that are to be found running wait at it. Not a value, so it stands beside what tests hand over.
struct Gate {
  void open() { is_open = true, is_open.notify_all(); }
  void pass() {
    is_reached = true, is_reached.notify_all();
    is_open.wait(false);
  }
  void wait_until_reached() const { is_reached.wait(false); }
  std::atomic<bool> is_open = false;
  std::atomic<bool> is_reached = false;
};
Gate* gate = nullptr;
std::atomic<int> calls = 0;

/// An argument or result of which every copy is counted.
struct Counted {
  explicit Counted(int number) : value(number) { ++alive; }
  Counted(Counted const& other) : value(other.value) { ++alive; }
  Counted(Counted&& other) noexcept : value(other.value) { ++alive; }
  Counted& operator=(Counted const&) = default;
  ~Counted() { --alive; }
  int value;
  static inline std::atomic<int> alive = 0;
};

struct Pool : ::testing::Test {
  Pool() { gate = &own_gate, calls = 0, Counted::alive = 0; }
  ~Pool() override { EXPECT_EQ(Counted::alive, 0) << "left behind"; }
  Gate own_gate;
};

int add(int a, int b) {
  return a + b;
}
std::unique_ptr<std::string> twice(std::unique_ptr<std::string> text) {
  return std::make_unique<std::string>(*text + *text);
}
Counted grow(Counted counted) {
  ++calls;
  return Counted(counted.value + 1);
}
Counted grow_behind_the_gate(Counted const& counted) {
  gate->pass();
  ++calls;
  return Counted(counted.value + 1);
}
Counted run_until_stopped(std::stop_token stop, Counted counted) {
  gate->pass();
  while (!stop.stop_requested()) std::this_thread::yield();
  ++calls;
  return counted;
}

TEST_F(Pool, GivesBackWhatAFunctionReturns) {
  Loop loop(unpaced, 2);
  auto ask = [&]() -> Task<int> { co_return co_await loop.on_pool(add, 40, 2); };
  EXPECT_EQ(loop.run_until_done(ask()), 42);
  EXPECT_EQ(loop.jobs_on_pool(), 0u);
}

TEST_F(Pool, MovesArgumentsInAndTheResultOut) {
  Loop loop(unpaced, 1);
  auto ask = [&]() -> Task<std::string> {
    auto text = std::make_unique<std::string>("tsee");
    auto const both = co_await loop.on_pool(twice, std::move(text));
    co_return *both;
  };
  EXPECT_EQ(loop.run_until_done(ask()), "tseetsee");
}

TEST_F(Pool, CopiesWhatIsNotMoved) {
  Loop loop(unpaced, 1);
  auto ask = [&]() -> Task<> {
    Counted const mine(1);
    auto const grown = co_await loop.on_pool(grow, mine);
    EXPECT_EQ(mine.value, 1);
    EXPECT_EQ(grown.value, 2);
    auto const of_temporary = co_await loop.on_pool(grow, Counted(2));
    EXPECT_EQ(of_temporary.value, 3);
    EXPECT_EQ(Counted::alive, 3) << "nothing else is kept";
  };
  loop.run_until_done(ask());
}

TEST_F(Pool, RunsOnAnotherThread) {
  Loop loop(unpaced, 1);
  auto ask = [&]() -> Task<bool> {
    auto const there = co_await loop.on_pool([] { return std::this_thread::get_id(); });
    co_return there != std::this_thread::get_id();
  };
  EXPECT_TRUE(loop.run_until_done(ask()));
}

TEST_F(Pool, TakesFunctionsThatReturnNothing) {
  Loop loop(unpaced, 1);
  auto ask = [&]() -> Task<> { co_await loop.on_pool([](int by) { calls += by; }, 3); };
  loop.run_until_done(ask());
  EXPECT_EQ(calls, 3);
}

TEST_F(Pool, ThrowsWhatAFunctionThrowsWhereItIsAwaited) {
  Loop loop(unpaced, 1);
  auto ask = [&]() -> Task<std::string> {
    try {
      (void)co_await loop.on_pool([](Counted) -> int { throw std::runtime_error("no such filter"); }, Counted(1));
    } catch (std::runtime_error const& error) {
      co_return error.what();
    }
    co_return "nothing was thrown";
  };
  EXPECT_EQ(loop.run_until_done(ask()), "no such filter");
}

TEST_F(Pool, HandsExpectedFailuresOnAsTheyAre) {
  Loop loop(unpaced, 1);
  auto ask = [&]() -> Task<Result<int>> {
    co_return co_await loop.on_pool([](int) -> Result<int> { return fail(ErrorKind::invalid_input, "empty scan"); }, 1);
  };
  EXPECT_EQ(loop.run_until_done(ask()).error().message, "empty scan");
}

TEST_F(Pool, GivesBackInTheOrderOfSubmissionWhicheverIsDoneFirst) {
  Loop loop(Loop::Pace{}, 2);
  Scope scope(loop);
  std::vector<int> order;
  auto ask = [&](int name, auto function) -> Task<> {
    (void)co_await loop.on_pool(function, Counted(name));
    order.push_back(name);
  };
  auto open_when_the_second_is_done = [&]() -> Task<> {
    while (calls == 0) co_await loop.sleep(1ms);
    co_await loop.sleep(5ms);
    EXPECT_TRUE(order.empty());
    gate->open();
  };
  scope.spawn(ask(1, grow_behind_the_gate));
  scope.spawn(ask(2, grow));
  scope.spawn(open_when_the_second_is_done());
  loop.run_until_done(scope.join());
  EXPECT_EQ(order, (std::vector{1, 2}));
}

TEST_F(Pool, TimeWithoutAPaceWaitsForIt) {
  Loop loop(unpaced, 1);
  Scope scope(loop);
  int steps = 0;
  auto step = [&]() -> Task<> {
    for (;; ++steps) co_await loop.sleep(1ms);
  };
  scope.spawn(step());
  auto ask = [&]() -> Task<> {
    co_await loop.sleep(5500us);
    co_await loop.on_pool([] { std::this_thread::sleep_for(20ms); });
    EXPECT_EQ(loop.now().time_since_epoch(), 5500us);
    EXPECT_EQ(steps, 5);
  };
  loop.run_until_done(ask());
}

TEST_F(Pool, TimeAtAnotherPaceThanTheWallsWaitsForIt) {
  Loop loop(Loop::Pace{.speedup = 200.0}, 1);
  Scope scope(loop);
  int steps = 0;
  auto step = [&]() -> Task<> {
    for (;; ++steps) co_await loop.sleep(1s);
  };
  scope.spawn(step());
  auto ask = [&]() -> Task<> {
    auto const began = loop.now();
    co_await loop.on_pool([] { std::this_thread::sleep_for(50ms); });
    EXPECT_LT(loop.now() - began, 1s) << "and not the 10 s that passed on the wall";
    EXPECT_LE(steps, 1);
    co_await loop.sleep(10s);
    EXPECT_GE(steps, 9) << "it goes on afterwards";
  };
  loop.run_until_done(ask());
}

TEST_F(Pool, TheWallsTimeGoesOn) {
  Loop loop(Loop::Pace{}, 1);
  auto open_in_time = [&]() -> Task<> {
    co_await loop.sleep(5ms);
    gate->open();
  };
  Scope scope(loop);
  scope.spawn(open_in_time());
  auto ask = [&]() -> Task<int> { co_return (co_await loop.on_pool(grow_behind_the_gate, Counted(1))).value; };
  EXPECT_EQ(loop.run_until_done(ask()), 2);
}

TEST_F(Pool, EventsAreServedWhileTimeWaits) {
  Loop loop(unpaced, 1);
  // As a signal, or a request of a browser.
  std::jthread const outside([&] {
    gate->wait_until_reached();
    loop.post_from_other_thread([] { gate->open(); });
  });
  auto ask = [&]() -> Task<int> { co_return (co_await loop.on_pool(grow_behind_the_gate, Counted(1))).value; };
  EXPECT_EQ(loop.run_until_done(ask()), 2);
}

TEST_F(Pool, OneThatIsCancelledBeforeItBeganIsDropped) {
  Loop loop(unpaced, 1);
  auto ask = [&](auto function) -> Task<> { (void)co_await loop.on_pool(function, Counted(1)); };
  Scope running(loop);
  Scope cancelled(loop);
  running.spawn(ask(grow_behind_the_gate));
  gate->wait_until_reached();
  auto const of_the_first = Counted::alive.load();
  cancelled.spawn(ask(grow));
  cancelled.spawn(ask(grow));
  EXPECT_EQ(loop.jobs_on_pool(), 3u);
  cancelled.clear();
  EXPECT_EQ(Counted::alive, of_the_first) << "at once";
  EXPECT_EQ(loop.jobs_on_pool(), 1u);
  gate->open();
  loop.run_until_done(running.join());
  EXPECT_EQ(calls, 1);
}

TEST_F(Pool, OneThatIsCancelledWhileItRunsIsAskedToStopAndItsResultThrownAway) {
  {
    Loop loop(unpaced, 1);
    Scope scope(loop);
    bool came_back = false;
    auto ask = [&]() -> Task<> {
      (void)co_await loop.on_pool(run_until_stopped, Counted(1));
      came_back = true;
    };
    scope.spawn(ask());
    gate->wait_until_reached();
    gate->open();
    scope.clear();
    EXPECT_EQ(loop.jobs_on_pool(), 0u);
    auto next = [&]() -> Task<int> { co_return (co_await loop.on_pool(grow, Counted(1))).value; };
    EXPECT_EQ(loop.run_until_done(next()), 2) << "its thread is free again";
    EXPECT_EQ(calls, 2);
    EXPECT_FALSE(came_back);
  }
}

TEST_F(Pool, OneThatIsCancelledWhenItIsDoneLeavesNothingBehind) {
  Loop loop(unpaced, 2);
  auto ask = [&](auto function) -> Task<> { (void)co_await loop.on_pool(function, Counted(1)); };
  Scope first(loop);
  Scope second(loop);
  first.spawn(ask(grow_behind_the_gate));
  second.spawn(ask([](Counted) { gate->open(); }));
  // The second is done before the first, and waits for its turn.
  auto cancel = [&]() -> Task<> {
    co_await first.join();
    second.clear();
  };
  loop.run_until_done(cancel());
  EXPECT_EQ(loop.jobs_on_pool(), 0u);
}

TEST_F(Pool, TheLoopsEndWaitsForWhatRuns) {
  {
    Loop loop(unpaced, 2);
    Scope scope(loop);
    auto ask = [&]() -> Task<> { (void)co_await loop.on_pool(run_until_stopped, Counted(1)); };
    scope.spawn(ask());
    gate->wait_until_reached();
    gate->open();
  }
  EXPECT_EQ(calls, 1);
}

std::ptrdiff_t threads_of_this_process() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
}

TEST_F(Pool, StartsNoMoreThreadsThanThereIsWorkFor) {
  std::thread([] {}).join();  // beside the first one a sanitizer starts one of its own
  Loop loop(unpaced, 8);
  auto const before = threads_of_this_process();
  auto ask = [&]() -> Task<> {
    for (int i = 0; i < 20; ++i) (void)co_await loop.on_pool(add, i, i);
  };
  loop.run_until_done(ask());
  EXPECT_EQ(threads_of_this_process() - before, 1);
}

TEST_F(Pool, HasOneThreadAtLeast) {
  EXPECT_GE(Loop::one_less_than_cores(), 1u);
}

Loop* loop_behind_its_back = nullptr;

TEST(PoolDeathTest, AFunctionThatReachesForTheLoopEndsTheProgram) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  Loop loop(unpaced, 1);
  loop_behind_its_back = &loop;
  auto ask = [&]() -> Task<> { co_await loop.on_pool([] { loop_behind_its_back->post([] {}); }); };
  EXPECT_DEATH(loop.run_until_done(ask()), "broken contract: !internal::is_on_pool");
}

// What may cross, and what may not.
struct Owner {
  int number = 0;
  int doubled() const { return 2 * number; }
};
template <class F, class... Args>
constexpr bool may_cross = PoolCall<std::decay_t<F>, std::decay_t<Args>...>;
using Doubled = decltype([](int number) { return 2 * number; });
using Captures = decltype([number = 3] { return number; });

static_assert(may_cross<Doubled, int>);
static_assert(may_cross<decltype(&Owner::doubled), Owner>);
static_assert(may_cross<decltype([](std::stop_token, int) {}), int>);
static_assert(may_cross<decltype([](std::shared_ptr<Owner const>) {}), std::shared_ptr<Owner const>>);
static_assert(!may_cross<Captures>, "what it captures cannot be seen");
static_assert(!may_cross<Doubled, std::string>, "wrong arguments");
static_assert(!may_cross<decltype([](int&) {}), int>, "it would change what nobody sees");
static_assert(!may_cross<decltype([](Owner*) {}), Owner*>);
static_assert(!may_cross<decltype([](Owner&) {}), std::reference_wrapper<Owner>>);
static_assert(!may_cross<decltype([](std::shared_ptr<Owner>) {}), std::shared_ptr<Owner>>, "others may change it");
static_assert(!may_cross<decltype([](std::string_view) {}), std::string_view>);
static_assert(!may_cross<decltype([](std::span<int const>) {}), std::span<int const>>);
static_assert(!may_cross<decltype([](std::string const& text) -> std::string_view { return text; }), std::string>,
              "what it would show dies with the argument");

}  // namespace
}  // namespace lapwing::base
