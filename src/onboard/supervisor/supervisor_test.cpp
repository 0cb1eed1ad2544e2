#include "onboard/supervisor/supervisor.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <array>
#include <csignal>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "onboard/life/life_line.hpp"

namespace lapwing::onboard {
namespace {

using namespace std::chrono_literals;
using Statuses = std::vector<ProcessStatus>;

ProcessSpec sleeper(std::string name) {
  return {.name = std::move(name), .command = {"sleep", "1000"}, .tells_life = false};
}

/// In real time: the processes are real ones.
struct SupervisorTest : ::testing::Test {
  bool comes_true(std::function<bool()> const& holds) {
    return loop.run_until_done([](base::Loop& on, std::function<bool()> wanted) -> base::Task<bool> {
      auto const deadline = on.now() + 10s;
      while (!wanted() && on.now() < deadline) co_await on.sleep(5ms);
      co_return wanted();
    }(loop, holds));
  }
  Supervisor& supervise(std::vector<ProcessSpec> processes) {
    hub.add_sink([this](base::LogRecord const& record) { lines.push_back(record.text); });
    supervisor.emplace(loop,
                       SupervisorOptions{.processes = std::move(processes),
                                         .longest_silence = 500ms,
                                         .stop_patience = 500ms,
                                         .back_off = {.first = 20ms, .most = 200ms}},
                       base::Logger(hub, "onboard"), [this](Statuses const& all) { told = all; });
    return *supervisor;
  }
  [[nodiscard]] bool all_run() const {
    for (auto const& one : supervisor->status())
      if (one.state != ProcessStatus::State::running) return false;
    return true;
  }
  [[nodiscard]] bool says(std::string const& words) const {
    for (auto const& line : lines)
      if (line.contains(words)) return true;
    return false;
  }

  base::Loop loop;
  base::LogHub hub;
  std::vector<std::string> lines;
  Statuses told;
  std::optional<Supervisor> supervisor;
};

TEST_F(SupervisorTest, HasAProcessStepBackBehindTheOthersThatIsToldTo) {
  auto nice = sleeper("perceive");
  nice.niceness = 7;
  supervise({sleeper("decide"), nice});
  ASSERT_TRUE(comes_true([&] { return all_run(); }));
  auto const niceness = [&](std::size_t process) {
    return ::getpriority(PRIO_PROCESS, static_cast<id_t>(supervisor->status()[process].pid));
  };
  EXPECT_EQ(niceness(1) - niceness(0), 7);
  auto const goes_before_others = [&](std::size_t process) {
    std::ifstream file(fmt::format("/proc/{}/oom_score_adj", supervisor->status()[process].pid));
    int score = 0;
    file >> score;
    return score;
  };
  EXPECT_GE(goes_before_others(1), 500);
  EXPECT_LT(goes_before_others(0), 500);
}

TEST_F(SupervisorTest, StartsAnewWhatWasKilledAndLeavesTheOthersAlone) {
  supervise({sleeper("bridge"), sleeper("decide")});
  ASSERT_TRUE(comes_true([&] { return all_run(); }));
  auto const before = supervisor->status();
  ::kill(before[1].pid, SIGKILL);
  ASSERT_TRUE(comes_true([&] { return supervisor->status()[1].restarts == 1 && all_run(); }));
  auto const after = supervisor->status();
  EXPECT_EQ(after[0].pid, before[0].pid);
  EXPECT_EQ(after[0].restarts, 0U);
  EXPECT_NE(after[1].pid, before[1].pid);
  EXPECT_EQ(after[1].last_end, "killed by signal 9 (Killed)");
  EXPECT_TRUE(says("decide killed by signal 9"));
  EXPECT_EQ(told[1].pid, after[1].pid) << "it was told";
}

TEST_F(SupervisorTest, NamesAndReplacesWhatWasStopped) {
  supervise({sleeper("bridge")});
  ASSERT_TRUE(comes_true([&] { return all_run(); }));
  ::kill(supervisor->status()[0].pid, SIGSTOP);
  ASSERT_TRUE(comes_true([&] { return supervisor->status()[0].restarts == 1 && all_run(); }));
  EXPECT_TRUE(says("bridge stopped by signal 19 (Stopped (signal)): it is ended by force"));
}

TEST_F(SupervisorTest, EndsWhatSaysNothing) {
  auto silent = sleeper("decide");
  silent.tells_life = true;
  supervise({silent});
  ASSERT_TRUE(comes_true([&] { return supervisor->status()[0].restarts > 0; }));
  EXPECT_TRUE(says("decide hangs: it has said nothing for 0."));
}

TEST_F(SupervisorTest, LetsLiveWhatSaysThatItLives) {
  ProcessSpec const lively{.name = "perceive",
                           .command = {"sh", "-c", "while printf . >&$LAPWING_LIFE_FD; do sleep 0.1; done"}};
  supervise({lively});
  ASSERT_TRUE(comes_true([&] { return all_run(); }));
  auto const began = loop.now();
  ASSERT_TRUE(comes_true([&] { return loop.now() - began > 1500ms; }));
  EXPECT_EQ(supervisor->status()[0].restarts, 0U);
}

/// The first one that this process may run on.
std::string a_processor() {
  cpu_set_t mine;
  int number = 0;
  if (::sched_getaffinity(0, sizeof mine, &mine) == 0)
    while (number < CPU_SETSIZE - 1 && !CPU_ISSET(number, &mine)) ++number;
  return std::to_string(number);
}

TEST_F(SupervisorTest, LetsLiveWhatWaitsForAProcessor) {
  if (!Child::start(sleeper("looked at"))->waited()) GTEST_SKIP() << "this system does not count how long threads wait";
  // Each life takes it some 50 ms of a processor, of which it gets a thirtieth.
  ProcessSpec slow{
      .name = "perceive",
      .command = {"taskset", "-c", a_processor(), "sh", "-c",
                  "while printf . >&$LAPWING_LIFE_FD; do i=0; while [ $i -lt 30000 ]; do i=$((i+1)); done; done"}};
  slow.niceness = 10;
  ProcessSpec const busy{.name = "busy",
                         .command = {"taskset", "-c", a_processor(), "sh", "-c", "while :; do :; done"},
                         .tells_life = false};
  supervise({slow, busy, busy, busy});
  ASSERT_TRUE(comes_true([&] { return all_run(); }));
  auto const began = loop.now();
  ASSERT_TRUE(comes_true([&] { return loop.now() - began > 4s; }));
  EXPECT_EQ(supervisor->status()[0].restarts, 0U);
  EXPECT_TRUE(says("perceive waits for a processor")) << "that it does is known";
}

TEST_F(SupervisorTest, GoesOnWithWhatFailsAtOnceAndSaysHowItFails) {
  supervise(
      {{.name = "mapper", .command = {"sh", "-c", "exit 3"}}, {.name = "ghost", .command = {"/no/such/program"}}});
  ASSERT_TRUE(comes_true([&] { return supervisor->status()[0].restarts > 2 && supervisor->status()[1].restarts > 2; }));
  EXPECT_TRUE(says("mapper ended with exit code 3; it is started again in"));
  EXPECT_TRUE(says("ghost does not start: /no/such/program"));
}

TEST_F(SupervisorTest, StopsTheLastOneFirst) {
  supervise({sleeper("bridge"), sleeper("decide")});
  ASSERT_TRUE(comes_true([&] { return all_run(); }));
  bool is_done = false;
  supervisor->stop([&] { is_done = true; });
  ASSERT_TRUE(comes_true([&] { return is_done; }));
  ASSERT_GE(lines.size(), 2U);
  EXPECT_EQ(lines[lines.size() - 2], "decide killed by signal 15 (Terminated)");
  EXPECT_EQ(lines.back(), "bridge killed by signal 15 (Terminated)");
  EXPECT_EQ(told[0].state, ProcessStatus::State::ended);
}

TEST_F(SupervisorTest, EndsByForceWhatDoesNotEnd) {
  supervise(
      {{.name = "deaf", .command = {"sh", "-c", "trap '' TERM; while :; do sleep 0.05; done"}, .tells_life = false}});
  ASSERT_TRUE(comes_true([&] { return all_run(); }));
  auto const pid = supervisor->status()[0].pid;
  // The shell sets its trap a moment after it has begun.
  auto const began = loop.now();
  ASSERT_TRUE(comes_true([&] { return loop.now() - began > 300ms; }));
  bool is_done = false;
  supervisor->stop([&] { is_done = true; });
  ASSERT_TRUE(comes_true([&] { return is_done; }));
  EXPECT_TRUE(says("deaf has not ended when it was told to"));
  EXPECT_NE(::kill(pid, 0), 0) << "it is gone";
}

TEST(SupervisorHealth, IsToldAsJson) {
  auto const text = status_text({{.name = "bridge", .state = ProcessStatus::State::running, .pid = 42},
                                 {.name = "decide", .restarts = 2, .last_end = "killed by signal 9 (Killed)"}},
                                base::UtcTime(1s));
  for (auto const* const part : {R"("name": "bridge")", R"("state": "running")", R"("pid": 42)", R"("restarts": 2)",
                                 R"j("last_end": "killed by signal 9 (Killed)")j", R"("state": "waits to start")"})
    EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(SupervisorTest, ALifeLineSaysThatItLivesAndLearnsThatItIsAlone) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()), 0);
  std::optional<base::Descriptor> far_end(std::in_place, ends[0]);
  bool is_orphaned = false;
  LifeLine const line(loop, base::Descriptor(ends[1]), [&] { is_orphaned = true; });
  std::array<char, 8> bytes{};
  bool has_said = false;
  ASSERT_TRUE(comes_true([&] {
    has_said = has_said || ::recv(far_end->get(), bytes.data(), bytes.size(), MSG_DONTWAIT) > 0;
    return has_said;
  }));
  EXPECT_FALSE(is_orphaned);
  far_end.reset();
  EXPECT_TRUE(comes_true([&] { return is_orphaned; }));
}

}  // namespace
}  // namespace lapwing::onboard
