#include "robot/watch/process_use.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

namespace lapwing::robot {

namespace {

base::Duration duration(timeval const& time) {
  return std::chrono::seconds(time.tv_sec) + std::chrono::microseconds(time.tv_usec);
}

}  // namespace

ProcessUse process_use() {
  ProcessUse use;
  // Pages in all, then pages that are in memory (proc(5)).
  std::ifstream pages("/proc/self/statm");
  std::uint64_t in_all = 0;
  std::uint64_t resident = 0;
  if (pages >> in_all >> resident) use.memory_bytes = resident * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  rusage taken{};
  if (::getrusage(RUSAGE_SELF, &taken) == 0) use.cpu = duration(taken.ru_utime) + duration(taken.ru_stime);
  return use;
}

double cpu_share(ProcessUse const& before, ProcessUse const& after, base::Duration between) {
  if (between <= base::Duration::zero()) return 0;
  return base::to_seconds(after.cpu - before.cpu) / base::to_seconds(between);
}

ProcessMeter::Use ProcessMeter::use() {
  auto const now = std::chrono::steady_clock::now();
  if (looked_at_ && now - *looked_at_ < std::chrono::seconds(1)) return use_;
  auto const seen = process_use();
  if (looked_at_) use_.cpu_share = cpu_share(seen_, seen, now - *looked_at_);
  use_.memory_bytes = seen.memory_bytes;
  looked_at_ = now;
  seen_ = seen;
  return use_;
}

}  // namespace lapwing::robot
