#include "onboard/supervisor/process_mark.hpp"

#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>

namespace lapwing::onboard {

/// proc(5): the name stands in brackets and may have any characters, so that fields count from behind the last bracket.
std::optional<std::uint64_t> began_at(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string const text{std::istreambuf_iterator<char>(file), {}};
  auto const end_of_name = text.rfind(')');
  if (end_of_name == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(end_of_name + 1));
  char state = 0;
  fields >> state;
  if (!fields || state == 'Z' || state == 'X') return std::nullopt;
  constexpr int between = 18;  // of the state, which is the third, and the start, which is the 22nd
  std::string passed_over;
  for (int i = 0; i < between; ++i) fields >> passed_over;
  std::uint64_t began = 0;
  fields >> began;
  return fields ? std::optional(began) : std::nullopt;
}

bool still_runs(ProcessMark const& mark) {
  return mark.pid > 0 && began_at(mark.pid) == mark.began;
}

std::string boot_id() {
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::string id;
  file >> id;
  return id;
}

}  // namespace lapwing::onboard
