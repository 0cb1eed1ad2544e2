// Another program's work: its lines, its end, its limits, and that it ends with whoever waits for it.
#include "base/async/child_program.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "base/async/scope.hpp"

namespace lapwing::base {
namespace {

using namespace std::chrono_literals;

struct ChildProgramTest : ::testing::Test {
  Loop loop;
  std::vector<std::string> lines;

  ChildProgram shell(std::string script) { return {.program = "/bin/sh", .words = {"-c", std::move(script)}}; }
  Result<ChildOutcome> run(ChildProgram child) {
    Result<ChildOutcome> result = fail(ErrorKind::cancelled, "not run");
    loop.run_until_done(
        into(run_child(loop, std::move(child), [this](auto line) { lines.emplace_back(line); }), result));
    return result;
  }
  static Task<> into(Task<Result<ChildOutcome>> work, Result<ChildOutcome>& result) {
    result = co_await std::move(work);
  }
};

TEST_F(ChildProgramTest, TellsItsLinesItsErrorsAndItsEnd) {
  auto const done = run(shell("echo one; echo two; printf three; echo trouble >&2; exit 3"));
  ASSERT_TRUE(done);
  EXPECT_EQ(done->exit_code, 3);
  EXPECT_EQ(done->errors, "trouble\n");
  EXPECT_EQ(lines, std::vector<std::string>({"one", "two"}));
}

TEST_F(ChildProgramTest, OneThatIsNotThereIsTold) {
  EXPECT_EQ(run({.program = "/nowhere/at/all", .words = {}}).error().kind, ErrorKind::not_found);
}

TEST_F(ChildProgramTest, TimeMemoryAndFilesAreLimited) {
  auto slow = shell("exec sleep 60");
  slow.longest = 1s;
  EXPECT_EQ(run(slow).error().kind, ErrorKind::timed_out);

  auto writer = shell("i=0; while [ $i -lt 64 ]; do printf '%1024s' x; i=$((i+1)); done > \"$0\"; echo written");
  writer.words.push_back((std::filesystem::temp_directory_path() / "lapwing-child-limit").string());
  writer.most_file_bytes = 4096;
  auto const written = run(writer);
  EXPECT_LE(std::filesystem::file_size(writer.words.back()), 4096U);
  std::filesystem::remove(writer.words.back());
  ASSERT_TRUE(written);
  EXPECT_NE(written->exit_code, 0);

  auto hungry = shell("ulimit -v");
  hungry.most_memory_bytes = std::uint64_t{512} << 20U;
  lines.clear();
  ASSERT_TRUE(run(hungry));
  EXPECT_EQ(lines, std::vector<std::string>({"524288"}));
}

TEST_F(ChildProgramTest, FloodsAreNotKept) {
  auto const done = run(shell("yes 0123456789abcdef | head -c 1000000 >&2; head -c 300000 /dev/zero; exit 0"));
  ASSERT_TRUE(done);
  EXPECT_LE(done->errors.size(), 16U * 1024U);
}

TEST_F(ChildProgramTest, EndsWithWhoWaitsForIt) {
  pid_t pid = 0;
  {
    Scope scope(loop);
    Result<ChildOutcome> never = fail(ErrorKind::cancelled, "not run");
    scope.spawn(into(run_child(loop, shell("echo $$; exec sleep 60"),
                               [&](auto line) { pid = std::atoi(std::string(line).c_str()); }),
                     never));
    loop.run_until_done([](Loop& on, pid_t& heard) -> Task<> {
      while (heard == 0) co_await on.sleep(1ms);
    }(loop, pid));
    EXPECT_EQ(::kill(pid, 0), 0);
  }
  EXPECT_NE(::kill(pid, 0), 0) << "it is gone, and nobody has to bury it";
}

TEST_F(ChildProgramTest, ItsTimeIsTheWallsWhateverTheLoopsPace) {
  Loop fast{{.speedup = 1000.0}};
  Result<ChildOutcome> done = fail(ErrorKind::cancelled, "not run");
  auto child = shell("sleep 0.3; echo late");
  child.longest = 30s;
  fast.run_until_done(into(run_child(fast, child), done));
  EXPECT_TRUE(done) << done.error().message;
}

}  // namespace
}  // namespace lapwing::base
