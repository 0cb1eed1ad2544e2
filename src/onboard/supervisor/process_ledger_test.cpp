#include "onboard/supervisor/process_ledger.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <optional>

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::onboard {
namespace {

using namespace std::chrono_literals;

constexpr auto boot = "b1";

ProcessSpec program(std::string name, std::string shell_words) {
  return {.name = std::move(name), .command = {"sh", "-c", std::move(shell_words)}, .tells_life = false};
}
ProcessSpec sleeper(std::string name) {
  return program(std::move(name), "exec sleep 1000");
}

std::vector<std::string> names_of(std::vector<ProcessMark> const& marks) {
  std::vector<std::string> names;
  for (auto const& mark : marks) names.push_back(mark.name);
  return names;
}

ProcessStatus running(std::string name, pid_t pid) {
  return {.name = std::move(name), .state = ProcessStatus::State::running, .pid = pid};
}

TEST(ProcessMark, TellsAProcessFromAnotherOneOfItsNumber) {
  auto const began = began_at(::getpid());
  ASSERT_TRUE(began);
  EXPECT_TRUE(still_runs({.name = "this", .pid = ::getpid(), .began = *began}));
  EXPECT_FALSE(still_runs({.name = "an earlier one", .pid = ::getpid(), .began = *began - 1}));
  EXPECT_FALSE(still_runs({.name = "none"}));
}

TEST(ProcessMark, TakesOneThatHasEndedForOneThatDoesNotRun) {
  auto const pid = ::fork();
  if (pid == 0) ::_exit(0);
  siginfo_t how{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(pid), &how, WEXITED | WNOWAIT), 0);
  EXPECT_FALSE(began_at(pid)) << "nobody has asked yet how it ended";
  ::waitpid(pid, nullptr, 0);
}

TEST(ProcessLedger, ReadsWhatItWrites) {
  std::vector<ProcessMark> const marks{{.name = "bridge", .pid = 41, .began = 7}, {.name = "decide", .pid = 42}};
  auto const read = read_ledger(ledger_text(marks, boot), boot);
  ASSERT_EQ(names_of(read), names_of(marks));
  EXPECT_EQ(read[0].pid, 41);
  EXPECT_EQ(read[0].began, 7U);
  EXPECT_TRUE(read_ledger(ledger_text(marks, boot), "b2").empty()) << "the machine was started anew";
}

TEST(ProcessLedger, LeavesOutWhatMakesNoSense) {
  auto const read = [](std::string const& processes) {
    return names_of(read_ledger(R"({"boot":"b1","processes":)" + processes + "}", boot));
  };
  EXPECT_TRUE(read_ledger("", boot).empty());
  EXPECT_TRUE(read_ledger("[]", boot).empty());
  EXPECT_TRUE(read("7").empty());
  // Numbers that would end whole groups of processes, or everything.
  for (auto const* const pid : {"-1", "0", "1", "99999999999", "\"7\"", "2.5", "null"})
    EXPECT_TRUE(read(std::string(R"([{"name":"a","began":1,"pid":)") + pid + "}]").empty()) << pid;
  EXPECT_EQ(read(R"([7,{"name":"a"},{"name":"b","pid":12,"began":-1},{"name":"c","pid":12,"began":3}])"),
            std::vector<std::string>{"c"});
}

TEST(ProcessLedger, IsHadByOneAtATime) {
  base::testing::TemporaryFolder const folder;
  std::optional<base::Result<ProcessLedger>> first(ProcessLedger::open(folder.path() / "state"));
  ASSERT_TRUE(*first);
  auto const second = ProcessLedger::open(folder.path() / "state");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, base::ErrorKind::refused);
  first.reset();
  EXPECT_TRUE(ProcessLedger::open(folder.path() / "state"));
}

/// Processes of an earlier supervisor that was killed, and the next one.
struct LeftOverTest : ::testing::Test {
  LeftOverTest() {
    hub.add_sink([this](base::LogRecord const& record) { lines.push_back(record.text); });
  }
  bool comes_true(std::function<bool()> const& holds) {
    return loop.run_until_done([](base::Loop& on, std::function<bool()> wanted) -> base::Task<bool> {
      auto const deadline = on.now() + 10s;
      while (!wanted() && on.now() < deadline) co_await on.sleep(5ms);
      co_return wanted();
    }(loop, holds));
  }
  void leave(std::vector<ProcessSpec> const& specs) {
    auto const ledger = ProcessLedger::open(folder.path());
    ASSERT_TRUE(ledger);
    std::vector<ProcessStatus> all;
    for (auto const& spec : specs) {
      auto child = Child::start(spec);
      ASSERT_TRUE(child);
      all.push_back(running(spec.name, child->pid()));
      left.push_back(*std::move(child));
    }
    ASSERT_TRUE(ledger->note(all));
  }
  /// As the system's first process does for orphans.
  void bury() {
    for (auto& child : left) (void)child.look();
  }
  [[nodiscard]] bool says(std::string const& words) const {
    for (auto const& line : lines)
      if (line.contains(words)) return true;
    return false;
  }

  base::Loop loop;
  base::LogHub hub;
  std::vector<std::string> lines;
  base::testing::TemporaryFolder folder;
  std::vector<Child> left;
};

TEST_F(LeftOverTest, IsEndedTheLastOneFirstBeforeAnythingIsStarted) {
  leave({sleeper("bridge"), sleeper("decide")});
  auto ledger = ProcessLedger::open(folder.path());
  ASSERT_TRUE(ledger);
  EXPECT_EQ(names_of(ledger->left_over()), (std::vector<std::string>{"bridge", "decide"}));
  std::vector<std::vector<std::string>> noted;
  Supervisor supervisor(loop, {.processes = {sleeper("bridge")}, .left_over = ledger->left_over()},
                        base::Logger(hub, "onboard"), [&](std::vector<ProcessStatus> const& all) {
                          ASSERT_TRUE(ledger->note(all));
                          auto const next = read_ledger(folder.read("processes.json"), boot_id());
                          noted.push_back(names_of(next));
                        });
  ASSERT_TRUE(comes_true([&] {
    bury();
    return supervisor.status()[0].pid != 0;
  }));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_TRUE(lines[0].starts_with("decide of an earlier start still runs")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with("bridge of an earlier start still runs")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("bridge runs")) << lines[2];
  EXPECT_TRUE(ledger->left_over().empty());
  ASSERT_EQ(noted.size(), 2U);
  EXPECT_EQ(noted[0], (std::vector<std::string>{"bridge", "decide"})) << "one that is killed now forgets nobody";
  EXPECT_EQ(noted[1], std::vector<std::string>{"bridge"});
}

TEST_F(LeftOverTest, IsEndedByForceWhenItDoesNotEnd) {
  leave({program("deaf", "trap '' TERM; while :; do sleep 0.05; done")});
  // The shell sets its trap a moment after it has begun.
  auto const began = loop.now();
  ASSERT_TRUE(comes_true([&] { return loop.now() - began > 300ms; }));
  Supervisor const supervisor(loop,
                              {.processes = {sleeper("bridge")},
                               .left_over = ProcessLedger::open(folder.path())->left_over(),
                               .stop_patience = 300ms},
                              base::Logger(hub, "onboard"));
  ASSERT_TRUE(comes_true([&] {
    bury();
    return supervisor.status()[0].pid != 0;
  }));
  EXPECT_TRUE(says("deaf of an earlier start does not end: it is ended by force"));
}

TEST_F(LeftOverTest, IsEndedWhenItWasStopped) {
  leave({sleeper("perceive")});
  left[0].signal(SIGSTOP);
  Supervisor const supervisor(
      loop, {.processes = {sleeper("bridge")}, .left_over = ProcessLedger::open(folder.path())->left_over()},
      base::Logger(hub, "onboard"));
  ASSERT_TRUE(comes_true([&] {
    bury();
    return supervisor.status()[0].pid != 0;
  }));
  EXPECT_FALSE(says("by force"));
}

}  // namespace
}  // namespace lapwing::onboard
