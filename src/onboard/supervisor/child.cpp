#include "onboard/supervisor/child.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "onboard/life/life_line.hpp"

namespace lapwing::onboard {

namespace {

/// The number that the child's end has there.
constexpr int life_number = 3;

std::vector<std::string> environment_with(std::string const& variable) {
  std::vector<std::string> all;
  auto const name = std::string(life_variable) + "=";
  for (char** one = environ; *one != nullptr; ++one)
    if (!std::string_view(*one).starts_with(name)) all.emplace_back(*one);
  all.push_back(name + variable);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (auto& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

/// Whoever steps back is also the first to go when memory runs out, which the system would otherwise decide by size.
void step_back(pid_t pid, int niceness) {
  constexpr auto goes_first = "500";
  // Its threads take it from the first one, which has just begun.
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(pid), ::getpriority(PRIO_PROCESS, 0) + niceness);
  base::Descriptor const score(::open(fmt::format("/proc/{}/oom_score_adj", pid).c_str(), O_WRONLY | O_CLOEXEC));
  if (score.is_open()) (void)score.write_all(goes_first);
}

int spawn(ProcessSpec const& spec, int life, pid_t& pid) {
  auto words = spec.command;
  auto variables = environment_with(std::to_string(life_number));
  posix_spawn_file_actions_t files;
  posix_spawnattr_t how;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawnattr_init(&how);
  ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  ::posix_spawn_file_actions_adddup2(&files, life, life_number);
  ::posix_spawn_file_actions_addclosefrom_np(&files, life_number + 1);
  sigset_t none;
  sigset_t all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&how, &none);
  ::posix_spawnattr_setsigdefault(&how, &all);
  ::posix_spawnattr_setpgroup(&how, 0);
  ::posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  int const error =
      ::posix_spawnp(&pid, words.front().c_str(), &files, &how, pointers(words).data(), pointers(variables).data());
  ::posix_spawnattr_destroy(&how);
  ::posix_spawn_file_actions_destroy(&files);
  return error;
}

}  // namespace

std::string to_string(ChildChange const& change) {
  switch (change.kind) {
    case ChildChange::Kind::exited: return fmt::format("ended with exit code {}", change.code);
    case ChildChange::Kind::killed:
      return fmt::format("killed by signal {} ({})", change.code, ::strsignal(change.code));
    case ChildChange::Kind::stopped:
      return fmt::format("stopped by signal {} ({})", change.code, ::strsignal(change.code));
  }
  return "unknown";
}

base::Result<Child> Child::start(ProcessSpec const& spec) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return base::fail(base::ErrorKind::io, fmt::format("{}: {}", spec.name, std::strerror(errno)));
  base::Descriptor ours(ends[0]);
  base::Descriptor const theirs(ends[1]);
  pid_t pid = 0;
  int const error = spawn(spec, theirs.get(), pid);
  if (error == 0) {
    if (spec.niceness != 0) step_back(pid, spec.niceness);
    return Child(pid, std::move(ours));
  }
  return base::fail(error == ENOENT ? base::ErrorKind::not_found : base::ErrorKind::io,
                    fmt::format("{} does not start: {}: {}", spec.name, spec.command.front(), std::strerror(error)),
                    "see `command` of this process in the configuration");
}

Child::Child(Child&& other) noexcept : pid_(std::exchange(other.pid_, 0)), life_(std::move(other.life_)) {}

Child::~Child() {
  if (pid_ <= 0) return;
  signal(SIGKILL);
  int status = 0;
  ::waitpid(pid_, &status, 0);  // at once: nothing survives that signal
}

std::optional<ChildChange> Child::look() {
  int status = 0;
  if (pid_ <= 0 || ::waitpid(pid_, &status, WNOHANG | WUNTRACED) != pid_) return std::nullopt;
  if (WIFSTOPPED(status)) return ChildChange{ChildChange::Kind::stopped, WSTOPSIG(status)};
  signal(SIGKILL);  // what it has started does not outlive it
  pid_ = 0;
  if (WIFSIGNALED(status)) return ChildChange{ChildChange::Kind::killed, WTERMSIG(status)};
  return ChildChange{ChildChange::Kind::exited, WEXITSTATUS(status)};
}

bool Child::has_lived() {
  std::array<char, 256> bytes{};
  bool has = false;
  while (::recv(life_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT) > 0) has = true;
  return has;
}

/// Linux, Documentation/scheduler/sched-stats: ns on a processor, ns of waiting for one, turns.
std::optional<base::Duration> Child::waited() const {
  std::ifstream file(fmt::format("/proc/{}/schedstat", pid_));
  std::uint64_t ran_ns = 0;
  std::uint64_t waited_ns = 0;
  file >> ran_ns >> waited_ns;
  if (!file) return std::nullopt;
  return std::chrono::duration_cast<base::Duration>(std::chrono::nanoseconds(waited_ns));
}

void Child::signal(int number) const {
  if (pid_ > 0) ::kill(-pid_, number);
}

}  // namespace lapwing::onboard
