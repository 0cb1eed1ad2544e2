#include "base/async/side_thread.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "base/async/scope.hpp"

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

struct Diary {
  std::vector<int> lines;
  std::thread::id written_by;
};

Task<> write_line(SideThread<Diary>& side, int line) {
  auto job = [line](Diary& diary) {
    diary.lines.push_back(line);
    diary.written_by = std::this_thread::get_id();
    return diary.lines.size();
  };
  EXPECT_EQ(co_await side.run(std::move(job)), static_cast<std::size_t>(line) + 1);
}

TEST(SideThread, DoesJobsInTheOrderOfTheCallsOnOneThreadOfItsOwn) {
  Loop loop;
  SideThread<Diary> side(loop, std::make_unique<Diary>());
  auto all = [&]() -> Task<Diary> {
    Scope scope(loop);
    for (int line = 0; line < 100; ++line) scope.spawn(write_line(side, line));
    co_await scope.join();
    co_return co_await side.run([](Diary& diary) { return diary; });
  };
  auto const diary = loop.run_until_done(all());
  ASSERT_EQ(diary.lines.size(), 100u);
  for (int line = 0; line < 100; ++line) EXPECT_EQ(diary.lines[static_cast<std::size_t>(line)], line);
  EXPECT_NE(diary.written_by, std::this_thread::get_id());
}

TEST(SideThread, BringsBackWhatCannotBeCopied) {
  Loop loop;
  SideThread<Diary> side(loop, std::make_unique<Diary>());
  auto value = std::make_unique<int>(7);
  auto job = [value = std::move(value)](Diary&) mutable { return std::move(value); };
  EXPECT_EQ(*loop.run_until_done(side.run(std::move(job))), 7);
}

TEST(SideThread, DoesWhatItWasAskedForBeforeItEnds) {
  std::atomic<int> done = 0;
  Loop loop;
  {
    SideThread<Diary> side(loop, std::make_unique<Diary>());
    for (int i = 0; i < 10; ++i)
      side.give([&done](Diary&) {
        std::this_thread::sleep_for(1ms);  // so that some have not begun when the destructor does
        ++done;
      });
  }
  EXPECT_EQ(done, 10);
}

TEST(SideThread, HasTimeWaitForWhatIsNeededInTime) {
  Loop loop(Loop::Pace{.unpaced = true});
  SideThread<Diary> side(loop, std::make_unique<Diary>());
  std::vector<int> order;
  auto ask = [&](int number) -> Task<> {
    auto const asked_at = loop.now();
    auto job = [number](Diary&) {
      std::this_thread::sleep_for(10ms);  // longer than the hour below
      return number;
    };
    auto work = side.run_in_time(std::move(job), 1s);
    order.push_back(co_await std::move(work));
    EXPECT_EQ(loop.now(), asked_at + 1s);
  };
  auto all = [&]() -> Task<> {
    Scope scope(loop);
    for (int number = 0; number < 3; ++number) scope.spawn(ask(number));
    order.push_back(co_await loop.on_pool([] { return 3; }));
    co_await scope.join();
    co_await loop.sleep(1h);
  };
  loop.run_until_done(all());
  EXPECT_EQ(order, std::vector<int>({3, 0, 1, 2}));
}

TEST(SideThread, FinishesAJobWhoseAwaiterIsGone) {
  std::atomic<bool> may_go_on = false;
  Loop loop;
  SideThread<Diary> side(loop, std::make_unique<Diary>());
  {
    Scope scope(loop);
    auto impatient = [&]() -> Task<> {
      auto job = [&may_go_on](Diary& diary) {
        may_go_on.wait(false);
        diary.lines.push_back(1);
        return true;
      };
      co_await side.run(std::move(job));
      ADD_FAILURE() << "the scope has ended";
    };
    scope.spawn(impatient());
  }
  may_go_on = true;
  may_go_on.notify_one();
  EXPECT_EQ(loop.run_until_done(side.run([](Diary& diary) { return diary.lines.size(); })), 1u);
}

}  // namespace
}  // namespace lapwing::base
