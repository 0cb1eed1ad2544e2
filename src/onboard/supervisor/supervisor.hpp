#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "link/operator_link/back_off.hpp"
#include "onboard/supervisor/child.hpp"
#include "onboard/supervisor/process_mark.hpp"

namespace lapwing::onboard {

/// How a process does.
struct ProcessStatus {
  enum class State { running, waits_to_start, ended };
  std::string name;
  State state = State::waits_to_start;
  pid_t pid = 0;               ///< while it runs
  std::uint64_t restarts = 0;  ///< since the supervisor began
  std::string last_end = {};   ///< how it ended last; empty: it has not
};
/// One JSON object, as the health file has it.
[[nodiscard]] std::string status_text(std::vector<ProcessStatus> const& all, base::UtcTime now);

struct SupervisorOptions {
  std::vector<ProcessSpec> processes;  ///< started in this order, stopped in the other one
  /// Of an earlier supervisor, in the order in which it had started them: they are ended first, since they hold the
  /// ports and steer the drone.
  std::vector<ProcessMark> left_over = {};
  base::Duration longest_silence = std::chrono::seconds(3);
  base::Duration stop_patience = std::chrono::seconds(12);  ///< until one that was told to end is killed
  base::Duration well_after = std::chrono::seconds(10);     ///< one that has lived so long did not fail at its start
  link::operator_link::BackOff::Limits back_off = {};
  std::uint64_t seed = 1;  ///< of the waits before restarts
};

/// Keeps the processes of a vehicle running: starts them, notices when one ends, is stopped or hangs, says so, and
/// starts it anew, after a wait that grows while it keeps failing. It never gives one up, and one that fails leaves the
/// others alone.
class Supervisor {
 public:
  /// `changed` is called whenever a status is another one.
  Supervisor(base::Loop& loop, SupervisorOptions options, base::Logger log,
             std::function<void(std::vector<ProcessStatus> const&)> changed = {});
  Supervisor(Supervisor const&) = delete;
  Supervisor& operator=(Supervisor const&) = delete;

  [[nodiscard]] std::vector<ProcessStatus> status() const;
  /// Tells them to end (SIGTERM), the one that was started last first, each when the one before it has ended; then
  /// calls `done`.
  void stop(std::function<void()> done);

 private:
  struct Process {
    ProcessSpec spec;
    ProcessStatus status;
    link::operator_link::BackOff back_off;
    std::optional<Child> child = {};
    base::TimePoint started{};
    base::TimePoint lived{};
    base::Duration waited{};  ///< for a processor, until it lived last
    bool is_starved = false;  ///< and that was said, once a start
    base::TimePoint next_start{};
  };
  base::Task<> supervise();
  /// As the one that started them would have: the last one first, each when the one before it has ended.
  base::Task<> end_left_over();
  base::Task<> end_all(std::function<void()> done);
  void look_after(Process& process);
  void start(Process& process);
  void ended(Process& process, std::string how);
  void lived(Process& process) const;
  /// One that waits for a processor does not hang, and to start it anew would take more of what is scarce.
  void judge_silence(Process& process);
  void end_by_force(Process& process, std::string const& why);
  void tell() const;

  base::Loop& loop_;
  SupervisorOptions options_;
  base::Logger log_;
  std::function<void(std::vector<ProcessStatus> const&)> changed_;
  std::list<Process> processes_;
  bool is_stopping_ = false;
  base::Scope scope_;
};

}  // namespace lapwing::onboard
