// Another program that is asked: its answers, its end, its silence.
#include "base/async/talking_child.hpp"

#include <gtest/gtest.h>
#include <sys/eventfd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <thread>

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

struct TalkingChildTest : ::testing::Test {
  void start(std::string script) {
    auto started = TalkingChild::start({.program = "/bin/sh", .words = {"-c", std::move(script)}}, stop.get());
    ASSERT_TRUE(started) << started.error().message;
    child = *std::move(started);
  }
  /// A line of its answer.
  Result<std::string> hear() {
    std::string text;
    std::array<char, 100> piece{};
    while (!text.ends_with('\n')) {
      auto const count = child->receive(piece, steady_clock::now() + 30s);
      if (!count) return std::unexpected(count.error());
      text.append(piece.data(), *count);
    }
    return text;
  }
  [[nodiscard]] static steady_clock::time_point soon() { return steady_clock::now() + 30s; }

  Descriptor stop{::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
  std::unique_ptr<TalkingChild> child;
};

TEST_F(TalkingChildTest, AnswersAsOftenAsItIsAsked) {
  start("while read word; do echo \"$word, too\"; done");
  ASSERT_TRUE(child->send("one\n", soon()));
  EXPECT_EQ(hear(), "one, too\n");
  ASSERT_TRUE(child->send("another\n", soon()));
  EXPECT_EQ(hear(), "another, too\n");
}

TEST_F(TalkingChildTest, TakesMoreThanAPipeHolds) {
  start("head -c 3000000 | wc -c");
  ASSERT_TRUE(child->send(std::string(3'000'000, 'x'), soon()));
  EXPECT_EQ(hear(), "3000000\n");
}

TEST_F(TalkingChildTest, TellsThatItHasEndedAndWhatItSaidOfThat) {
  start("read word; echo well >&2; echo 'no letters' >&2; exit 3");
  ASSERT_TRUE(child->send("one\n", soon()));
  auto const answer = hear();
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().kind, ErrorKind::lost);
  EXPECT_EQ(answer.error().message, "sh has ended: well no letters");
  EXPECT_EQ(child->send("two\n", soon()).error().kind, ErrorKind::lost) << "and no signal of a broken pipe";
}

TEST_F(TalkingChildTest, ASilentOneIsWaitedForNoLongerThanWasSaid) {
  start("exec sleep 60");
  std::array<char, 10> piece{};
  EXPECT_EQ(child->receive(piece, steady_clock::now() + 50ms).error().kind, ErrorKind::timed_out);
  EXPECT_EQ(child->send(std::string(8'000'000, 'x'), steady_clock::now() + 50ms).error().kind, ErrorKind::timed_out);
}

TEST_F(TalkingChildTest, IsWaitedForNoLongerThanSomebodyWants) {
  start("exec sleep 60");
  std::jthread const other([this] {
    std::uint64_t const one = 1;
    EXPECT_EQ(::write(stop.get(), &one, sizeof one), static_cast<ssize_t>(sizeof one));
  });
  std::array<char, 10> piece{};
  EXPECT_EQ(child->receive(piece, steady_clock::now() + 30s).error().kind, ErrorKind::cancelled);
}

TEST_F(TalkingChildTest, EndsWithThis) {
  start("echo $$; exec sleep 60");
  auto const pid = hear();
  ASSERT_TRUE(pid);
  int const number = std::atoi(pid->c_str());
  EXPECT_EQ(::kill(number, 0), 0);
  child.reset();
  EXPECT_NE(::kill(number, 0), 0);
}

TEST_F(TalkingChildTest, OneThatIsNotThereIsTold) {
  auto const started = TalkingChild::start({.program = "/nowhere/at/all"}, stop.get());
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().kind, ErrorKind::not_found);
}

}  // namespace
}  // namespace lapwing::base
