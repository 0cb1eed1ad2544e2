#include "base/async/internal/spawn_child.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace lapwing::base::internal {

namespace {

constexpr char const* prlimit = "/usr/bin/prlimit";

/// The command line of util-linux's prlimit, which limits itself and then becomes the program. Limits that were set on
/// the running program from here could come after it has written or asked for what they forbid.
std::vector<std::string> limited(ChildProgram const& child) {
  std::vector<std::string> words{prlimit, fmt::format("--as={}", child.most_memory_bytes),
                                 fmt::format("--fsize={}", child.most_file_bytes), "--core=0"};
  if (child.longest.count() > 0) words.push_back(fmt::format("--cpu={}", child.longest.count() + 1));
  words.insert(words.end(), {"--", child.program.string()});
  words.insert(words.end(), child.words.begin(), child.words.end());
  return words;
}

}  // namespace

int spawn_child(ChildProgram const& child, ChildFiles const& ours, pid_t& pid) {
  auto spelt = limited(child);
  std::vector<char*> words;
  for (auto& word : spelt) words.push_back(word.data());
  words.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawnattr_t how;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawnattr_init(&how);
  if (ours.in < 0) {
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  } else {
    ::posix_spawn_file_actions_adddup2(&files, ours.in, STDIN_FILENO);
  }
  ::posix_spawn_file_actions_adddup2(&files, ours.out, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, ours.errors, STDERR_FILENO);
  ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  sigset_t none;
  sigset_t all;
  ::sigemptyset(&none);
  ::sigfillset(&all);
  ::posix_spawnattr_setsigmask(&how, &none);
  ::posix_spawnattr_setsigdefault(&how, &all);
  ::posix_spawnattr_setpgroup(&how, 0);
  ::posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  int const error = ::posix_spawn(&pid, prlimit, &files, &how, words.data(), environ);
  ::posix_spawnattr_destroy(&how);
  ::posix_spawn_file_actions_destroy(&files);
  if (error == 0) (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(pid), child.niceness);
  return error;
}

}  // namespace lapwing::base::internal
