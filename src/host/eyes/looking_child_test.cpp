// Programs that answer, die, hang, talk nonsense and are not there, in place of the one that looks at pictures.
#include "host/eyes/looking_child.hpp"

#include <gtest/gtest.h>

#include "base/async/scope.hpp"
#include "base/testing/temporary_folder.hpp"

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;
using base::ErrorKind;

LookFrame request() {
  return {.head = {{"look", "signs"}}};
}

struct LookingChildTest : ::testing::Test {
  /// A line of its own for each request.
  void start(std::string script) {
    child = std::make_unique<LookingChild>(
        loop,
        LookingChild::Settings{.program = {.program = "/bin/sh", .words = {"-c", std::move(script)}, .longest = 0s},
                               .longest_look = 1s},
        base::Logger(hub, "test"));
  }
  base::Result<LookFrame> ask() { return loop.run_until_done(child->ask(&request)); }
  void pass(base::Duration time) {
    loop.run_until_done(
        [](base::Loop& on, base::Duration so_long) -> base::Task<> { co_await on.sleep(so_long); }(loop, time));
  }

  base::testing::TemporaryFolder folder;
  std::vector<std::string> said;
  base::LogHub hub;
  base::Loop loop{base::Loop::Pace{.unpaced = true}};
  std::unique_ptr<LookingChild> child;

  void SetUp() override {
    hub.add_sink([this](base::LogRecord const& record) { said.push_back(record.text); });
  }
};

TEST_F(LookingChildTest, TakesTheSameTimeForEachLook) {
  start("while read line; do echo '{\"signs\": [], \"bytes\": 2}'; printf hi; done");
  for (int i = 0; i < 3; ++i) {
    auto const began = loop.now();
    auto const answer = ask();
    ASSERT_TRUE(answer) << answer.error().message;
    EXPECT_EQ(answer->body, "hi");
    EXPECT_EQ(loop.now(), began + 400ms);
  }
  EXPECT_TRUE(said.empty());
}

TEST_F(LookingChildTest, AtTheWallsPaceNeitherTimeNorThePoolWaits) {
  base::Loop real;
  LookingChild slow(real,
                    {.program = {.program = "/bin/sh",
                                 .words = {"-c", "read line; while [ ! -e \"$0\" ]; do sleep 0.01; done; echo '{}'",
                                           (folder.path() / "go").string()},
                                 .longest = 0s},
                     .takes = std::nullopt},
                    base::Logger(hub, "test"));
  base::Scope scope(real);
  bool is_answered = false;
  scope.spawn([](LookingChild& asked, bool& done) -> base::Task<> {
    done = (co_await asked.ask(&request)).has_value();
  }(slow, is_answered));
  auto other = [](base::Loop& on) -> base::Task<int> { co_return co_await on.on_pool([] { return 7; }); };
  EXPECT_EQ(real.run_until_done(other(real)), 7) << "while the child has not answered";
  EXPECT_FALSE(is_answered);
  (void)folder.write("go", "");
  real.run_until_done(scope.join());
  EXPECT_TRUE(is_answered);
}

TEST_F(LookingChildTest, OneThatDiesIsStartedAnewAfterAWhileAndThatIsSaidOnce) {
  // It dies twice and then answers.
  auto const lives = (folder.path() / "lives").string();
  start("read line; echo x >> " + lives + "; [ $(wc -l < " + lives +
        ") -lt 3 ] && { echo no letters >&2; exit 1; }; echo '{}'");
  auto const died = ask();
  ASSERT_FALSE(died);
  EXPECT_EQ(died.error().kind, ErrorKind::lost);
  EXPECT_FALSE(child->may_be_asked());
  EXPECT_EQ(ask().error().kind, ErrorKind::lost) << "without being started";
  pass(1s);
  EXPECT_TRUE(child->may_be_asked());
  EXPECT_FALSE(ask());
  pass(1s);
  EXPECT_FALSE(child->may_be_asked()) << "later each time";
  pass(1s);
  EXPECT_TRUE(ask());
  ASSERT_EQ(said.size(), 2U);
  EXPECT_NE(said[0].find("no letters"), std::string::npos) << said[0];
  EXPECT_EQ(said[1], "pictures are looked at again");
}

TEST_F(LookingChildTest, OneThatHangsIsEnded) {
  start("exec sleep 60");
  EXPECT_FALSE(child->is_failing());
  EXPECT_EQ(ask().error().kind, ErrorKind::timed_out);
  EXPECT_FALSE(child->may_be_asked());
  EXPECT_TRUE(child->is_failing());
  EXPECT_FALSE(child->asked_since()) << "it owes nothing any more";
}

TEST_F(LookingChildTest, OwesAnAnswerFromTheQuestionOnUntilItHasCome) {
  base::Loop real;
  LookingChild slow(real,
                    {.program = {.program = "/bin/sh",
                                 .words = {"-c", "while read line; do while [ ! -e " + (folder.path() / "go").string() +
                                                     " ]; do :; done; echo '{}'; done"},
                                 .longest = 0s},
                     .takes = std::nullopt},
                    base::Logger(hub, "test"));
  EXPECT_FALSE(slow.asked_since());
  base::Scope scope(real);
  auto const asked_at = real.now();
  for (int i = 0; i < 2; ++i)
    scope.spawn([](LookingChild& asked) -> base::Task<> { (void)co_await asked.ask(&request); }(slow));
  real.run_until_done([](base::Loop& on) -> base::Task<> { co_await on.turn(); }(real));
  ASSERT_TRUE(slow.asked_since());
  EXPECT_GE(*slow.asked_since(), asked_at);
  (void)folder.write("go", "");
  real.run_until_done(scope.join());
  EXPECT_FALSE(slow.asked_since());
}

TEST_F(LookingChildTest, NonsenseIsNoAnswer) {
  start("read line; echo nonsense; sleep 60");
  EXPECT_EQ(ask().error().kind, ErrorKind::invalid_input);
  EXPECT_FALSE(child->may_be_asked());
}

TEST_F(LookingChildTest, MoreThanAnAnswerIsNone) {
  start("read line; printf '{}\\n{}\\n'; sleep 60");
  EXPECT_EQ(ask().error().kind, ErrorKind::invalid_input);
}

TEST_F(LookingChildTest, ARefusalIsAnAnswer) {
  start("while read line; do echo '{\"error\": \"it is black\"}'; done");
  EXPECT_TRUE(ask());
  EXPECT_TRUE(child->may_be_asked());
}

TEST_F(LookingChildTest, WhereThereIsNoneThatIsSaidOnce) {
  child = std::make_unique<LookingChild>(loop, LookingChild::Settings{.program = {.program = "/nowhere/at/all"}},
                                         base::Logger(hub, "test"));
  EXPECT_EQ(ask().error().kind, ErrorKind::not_found);
  EXPECT_FALSE(child->may_be_asked());
  pass(1h);
  EXPECT_EQ(ask().error().kind, ErrorKind::not_found);
  EXPECT_EQ(said.size(), 1U);
}

TEST_F(LookingChildTest, NobodyWaitsForItsAnswerWhenThisEnds) {
  auto const began = std::chrono::steady_clock::now();
  {
    base::Loop ends;
    LookingChild silent(
        ends, {.program = {.program = "/bin/sh", .words = {"-c", "exec sleep 60"}, .longest = 0s}, .longest_look = 60s},
        base::Logger(hub, "test"));
    base::Scope scope(ends);
    scope.spawn([](LookingChild& asked) -> base::Task<> { (void)co_await asked.ask(&request); }(silent));
    ends.run_until_done([](base::Loop& on) -> base::Task<> { co_await on.turn(); }(ends));
  }
  EXPECT_LT(std::chrono::steady_clock::now() - began, 30s);
}

}  // namespace
}  // namespace lapwing::host
