#include "onboard/supervisor/process_ledger.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/files/replace_file.hpp"
#include "base/text/json.hpp"

namespace lapwing::onboard {

namespace {

namespace fs = std::filesystem;

constexpr auto ledger_name = "processes.json";
constexpr auto lock_name = "onboard.lock";

std::string content_of(fs::path const& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::unexpected<base::Error> failed(fs::path const& path, std::string const& why) {
  return base::fail(base::ErrorKind::io, fmt::format("{}: {}", path.string(), why),
                    "see `state_folder` of [decide] in the configuration");
}

}  // namespace

base::Result<ProcessLedger> ProcessLedger::open(fs::path const& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return failed(folder, error.message());
  auto const lock_file = folder / lock_name;
  base::Descriptor lock(::open(lock_file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
  if (!lock.is_open()) return failed(lock_file, std::strerror(errno));
  if (::flock(lock.get(), LOCK_EX | LOCK_NB) == 0) return ProcessLedger(folder / ledger_name, std::move(lock));
  if (errno != EWOULDBLOCK) return failed(lock_file, std::strerror(errno));
  return base::fail(base::ErrorKind::refused,
                    fmt::format("another lapwing onboard has the state folder {}", folder.string()),
                    "stop that one first, or give this vehicle a state_folder of its own");
}

ProcessLedger::ProcessLedger(fs::path file, base::Descriptor lock)
    : file_(std::move(file)), lock_(std::move(lock)), found_(read_ledger(content_of(file_), boot_id())) {}

std::vector<ProcessMark> ProcessLedger::left_over() const {
  std::vector<ProcessMark> running;
  for (auto const& mark : found_)
    if (still_runs(mark)) running.push_back(mark);
  return running;
}

base::Result<> ProcessLedger::note(std::vector<ProcessStatus> const& all) const {
  auto marks = left_over();
  for (auto const& one : all)
    if (auto const began = began_at(one.pid)) marks.push_back({.name = one.name, .pid = one.pid, .began = *began});
  return base::replace_file(file_, ledger_text(marks, boot_id()));
}

std::string ledger_text(std::vector<ProcessMark> const& marks, std::string const& boot) {
  nlohmann::ordered_json text{{"boot", boot}, {"processes", nlohmann::ordered_json::array()}};
  for (auto const& mark : marks)
    text["processes"].push_back({{"name", mark.name}, {"pid", mark.pid}, {"began", mark.began}});
  return base::to_text(text, 2) + "\n";
}

std::vector<ProcessMark> read_ledger(std::string_view text, std::string const& boot) {
  std::vector<ProcessMark> marks;
  auto const ledger = nlohmann::json::parse(text, nullptr, false);
  if (!ledger.is_object() || ledger.value("boot", nlohmann::json()) != boot) return marks;
  auto const processes = ledger.find("processes");
  if (processes == ledger.end() || !processes->is_array()) return marks;
  constexpr std::int64_t first_of_programs = 2;  // 1 is the system's own, and what is below means whole groups
  for (auto const& one : *processes) {
    auto const has = [&one](char const* key) { return one.is_object() && one.contains(key); };
    if (!has("name") || !has("pid") || !has("began")) continue;
    if (!one["name"].is_string() || !one["pid"].is_number_integer() || !one["began"].is_number_unsigned()) continue;
    auto const pid = one["pid"].get<std::int64_t>();
    if (pid < first_of_programs || pid > std::numeric_limits<pid_t>::max()) continue;
    marks.push_back({.name = one["name"].get<std::string>(),
                     .pid = static_cast<pid_t>(pid),
                     .began = one["began"].get<std::uint64_t>()});
  }
  return marks;
}

}  // namespace lapwing::onboard
