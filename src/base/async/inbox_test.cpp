#include "base/async/inbox.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "base/async/scope.hpp"

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

Task<std::vector<int>> receive_all(Inbox<int>& inbox, Duration timeout) {
  std::vector<int> all;
  for (;;) {
    auto const message = co_await inbox.receive(timeout);
    if (!message) co_return all;
    all.push_back(*message);
  }
}

TEST(Inbox, WakesTheLoopForWhatAnotherThreadPosts) {
  Loop loop;
  Inbox<std::unique_ptr<int>> inbox(loop, 4, Overflow::drop_oldest);
  std::jthread const library([post = inbox.post()] {
    std::this_thread::sleep_for(20ms);  // so that the loop sleeps
    EXPECT_TRUE(post(std::make_unique<int>(7)));
  });
  auto const message = loop.run_until_done(inbox.receive(1min));
  ASSERT_TRUE(message);
  EXPECT_EQ(**message, 7);
  EXPECT_LT(loop.now().time_since_epoch(), 30s);
}

TEST(Inbox, KeepsEachThreadsOrderAndLosesNothingThatItHasRoomFor) {
  constexpr int each = 2000;
  Loop loop;
  Inbox<std::pair<int, int>> inbox(loop, 4 * each, Overflow::drop_newest);
  std::vector<std::jthread> threads;
  for (int thread = 0; thread < 4; ++thread)
    threads.emplace_back([post = inbox.post(), thread] {
      for (int i = 0; i < each; ++i) EXPECT_TRUE(post({thread, i}));
    });
  auto take = [&]() -> Task<std::vector<int>> {
    std::vector<int> next(4);
    for (int i = 0; i < 4 * each; ++i) {
      auto const message = co_await inbox.receive(1min);
      EXPECT_TRUE(message && message->second == next.at(static_cast<std::size_t>(message->first))++);
    }
    co_return next;
  };
  EXPECT_EQ(loop.run_until_done(take()), std::vector<int>(4, each));
  EXPECT_EQ(inbox.dropped(), 0u);
}

TEST(Inbox, DropsTheOldestOrTheNewestAndCountsThem) {
  Loop loop(Loop::Pace{.unpaced = true});
  Inbox<int> newest_count(loop, 3, Overflow::drop_oldest);
  Inbox<int> oldest_count(loop, 3, Overflow::drop_newest);
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(newest_count.post()(i));
    EXPECT_EQ(oldest_count.post()(i), i < 3);
  }
  EXPECT_EQ(loop.run_until_done(receive_all(newest_count, 1s)), (std::vector{2, 3, 4}));
  EXPECT_EQ(loop.run_until_done(receive_all(oldest_count, 1s)), (std::vector{0, 1, 2}));
  EXPECT_EQ(newest_count.dropped(), 2u);
  EXPECT_EQ(oldest_count.dropped(), 2u);
}

TEST(Inbox, TimesOutWhenNothingComes) {
  Loop loop(Loop::Pace{.unpaced = true});
  Inbox<int> inbox(loop, 1, Overflow::drop_oldest);
  EXPECT_EQ(loop.run_until_done(inbox.receive(3s)).error(), ReceiveError::timed_out);
  EXPECT_EQ(loop.now().time_since_epoch(), 3s);
}

TEST(Inbox, DeliversWhatWasPostedBeforeItWasClosedAndTakesNothingMore) {
  Loop loop(Loop::Pace{.unpaced = true});
  Inbox<int> inbox(loop, 4, Overflow::drop_oldest);
  auto const post = inbox.post();
  EXPECT_TRUE(post(1));
  inbox.close();
  EXPECT_FALSE(post(2));
  EXPECT_EQ(loop.run_until_done(receive_all(inbox, 1h)), std::vector{1});
  EXPECT_EQ(loop.run_until_done(inbox.receive(1h)).error(), ReceiveError::closed);
  EXPECT_EQ(inbox.dropped(), 0u) << "what was refused after the end was not lost by being slow";
}

TEST(Inbox, ClosingItWakesWhoWaits) {
  Loop loop(Loop::Pace{.unpaced = true});
  Inbox<int> inbox(loop, 4, Overflow::drop_oldest);
  loop.post([&] { inbox.close(); });
  EXPECT_EQ(loop.run_until_done(inbox.receive(1h)).error(), ReceiveError::closed);
  EXPECT_EQ(loop.now().time_since_epoch(), 0s);
}

TEST(Inbox, MayGoWhileThreadsPostAndLeavesNothingBehind) {
  auto const message = std::make_shared<int const>(1);
  std::jthread library;
  {
    Loop loop;
    Inbox<std::shared_ptr<int const>> inbox(loop, 8, Overflow::drop_oldest);
    library = std::jthread([post = inbox.post(), message] {
      while (post(message)) {
      }
    });
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(loop.run_until_done(inbox.receive(1min)));
  }
  library = {};  // it ends when its post is refused
  EXPECT_EQ(message.use_count(), 1);
}

TEST(Inbox, ReceiverDestroyedWhileWaitingIsNeverWoken) {
  Loop loop(Loop::Pace{.unpaced = true});
  Inbox<int> inbox(loop, 4, Overflow::drop_oldest);
  {
    Scope scope(loop);
    auto wait = [&]() -> Task<void> { (void)co_await inbox.receive(1h); };
    scope.spawn(wait());
  }
  EXPECT_TRUE(inbox.post()(1));
  EXPECT_EQ(inbox.size(), 1u);
  EXPECT_EQ(loop.run_until_done(receive_all(inbox, 1s)), std::vector{1});
}

}  // namespace
}  // namespace lapwing::base
