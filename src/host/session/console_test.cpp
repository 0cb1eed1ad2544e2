#include "host/session/console.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <array>
#include <cstdio>

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::host {
namespace {

struct ConsoleTest : ::testing::Test {
  ConsoleTest() : standard_input_(::dup(STDIN_FILENO)) {
    hub.add_sink([this](base::LogRecord const& record) { logged.push_back(record.source + ": " + record.text); });
  }
  ~ConsoleTest() override {
    ::dup2(standard_input_, STDIN_FILENO);
    ::close(standard_input_);
  }
  /// From here on standard input is a pipe with that text in it, and then its end.
  static void type(std::string_view text) {
    std::array<int, 2> ends{};
    ASSERT_EQ(::pipe(ends.data()), 0);
    ASSERT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
    ::close(ends[1]);
    ::dup2(ends[0], STDIN_FILENO);
    ::close(ends[0]);
  }
  base::Result<std::string> ask() { return loop.run_until_done(console->ask("name? ")); }

  base::Loop loop;
  std::vector<std::string> logged;
  base::LogHub hub;
  std::unique_ptr<dolphin::Output> console = make_console(loop, base::Logger(hub, "lapwing"));

 private:
  int standard_input_;
};

TEST_F(ConsoleTest, WritesToStandardOutputAsItIs) {
  ::testing::internal::CaptureStdout();
  console->write("one\ntw");
  console->write("o");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "one\ntwo");
}

TEST_F(ConsoleTest, LogsWholeLines) {
  ::testing::internal::CaptureStdout();
  console->write("one\ntw");
  EXPECT_EQ(logged, (std::vector<std::string>{"script: one"}));
  console->write("o\n\nthree\n");
  EXPECT_EQ(logged, (std::vector<std::string>{"script: one", "script: two", "script: ", "script: three"}));
  (void)::testing::internal::GetCapturedStdout();
}

TEST_F(ConsoleTest, AsksAndReadsOneLineAQuestion) {
  type("Ada\nGrace\nlast");
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(ask().value(), "Ada");
  EXPECT_EQ(ask().value(), "Grace");
  EXPECT_EQ(ask().value(), "last") << "without a line end, too";
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "name? name? name? ");
}

TEST_F(ConsoleTest, FailsWhenTheInputHasEnded) {
  type("");
  auto const answer = ask();
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().kind, base::ErrorKind::io);
}

TEST_F(ConsoleTest, ReadsAnswersFromAFile) {
  base::testing::TemporaryFolder const folder;
  int const file = ::open(folder.write("answers", "yes\n").c_str(), O_RDONLY);
  ::dup2(file, STDIN_FILENO);
  ::close(file);
  std::fflush(stdin);
  EXPECT_EQ(ask().value(), "yes");
  EXPECT_FALSE(ask());
}

}  // namespace
}  // namespace lapwing::host
