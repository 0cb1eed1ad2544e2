#include "onboard/supervisor/supervisor.hpp"

#include <csignal>
#include <ranges>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text/json.hpp"
#include "base/text/utc_text.hpp"

namespace lapwing::onboard {

using namespace std::chrono_literals;

namespace {

/// How soon an end is noticed.
constexpr base::Duration look_period = 100ms;

std::string_view to_string(ProcessStatus::State state) {
  switch (state) {
    case ProcessStatus::State::running: return "running";
    case ProcessStatus::State::waits_to_start: return "waits to start";
    case ProcessStatus::State::ended: return "ended";
  }
  return "unknown";
}

}  // namespace

std::string status_text(std::vector<ProcessStatus> const& all, base::UtcTime now) {
  nlohmann::ordered_json text{{"at", base::utc_text(now)}, {"processes", nlohmann::ordered_json::array()}};
  for (auto const& one : all) {
    nlohmann::ordered_json process{{"name", one.name}, {"state", to_string(one.state)}, {"restarts", one.restarts}};
    process["pid"] = one.pid > 0 ? nlohmann::ordered_json(one.pid) : nlohmann::ordered_json();
    process["last_end"] = one.last_end.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(one.last_end);
    text["processes"].push_back(std::move(process));
  }
  return text.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Supervisor::Supervisor(base::Loop& loop, SupervisorOptions options, base::Logger log,
                       std::function<void(std::vector<ProcessStatus> const&)> changed)
    : loop_(loop), options_(std::move(options)), log_(std::move(log)), changed_(std::move(changed)), scope_(loop) {
  for (auto const& spec : options_.processes)
    processes_.push_back({.spec = spec,
                          .status = {.name = spec.name},
                          .back_off = link::operator_link::BackOff(options_.back_off, options_.seed++)});
  scope_.spawn(supervise());
}

std::vector<ProcessStatus> Supervisor::status() const {
  std::vector<ProcessStatus> all;
  for (auto const& process : processes_) all.push_back(process.status);
  return all;
}

void Supervisor::tell() const {
  if (changed_) changed_(status());
}

base::Task<> Supervisor::supervise() {
  tell();
  auto ending = end_left_over();
  co_await std::move(ending);
  for (;;) {
    for (auto& process : processes_) look_after(process);
    co_await loop_.sleep(look_period);
  }
}

base::Task<> Supervisor::end_left_over() {
  for (auto const& mark : std::views::reverse(options_.left_over)) {
    if (!still_runs(mark)) continue;
    log_.warn(fmt::format("{} of an earlier start still runs, process {}: it is told to end", mark.name, mark.pid));
    ::kill(-mark.pid, SIGTERM);
    ::kill(-mark.pid, SIGCONT);  // one that was stopped does not hear it otherwise
    auto const deadline = loop_.now() + options_.stop_patience;
    while (still_runs(mark) && loop_.now() < deadline) co_await loop_.sleep(look_period);
    if (!still_runs(mark)) continue;
    log_.error(fmt::format("{} of an earlier start does not end: it is ended by force", mark.name));
    ::kill(-mark.pid, SIGKILL);
    // It goes at once, unless the system waits for a disk or a device on its behalf.
    auto const last = loop_.now() + options_.longest_silence;
    while (still_runs(mark) && loop_.now() < last) co_await loop_.sleep(look_period);
  }
}

void Supervisor::start(Process& process) {
  auto child = Child::start(process.spec);
  if (!child) return ended(process, child.error().message);
  process.child.emplace(*std::move(child));
  process.started = loop_.now();
  process.is_starved = false;
  lived(process);
  process.status.state = ProcessStatus::State::running;
  process.status.pid = process.child->pid();
  log_.info(fmt::format("{} runs, process {}", process.spec.name, process.status.pid));
  tell();
}

void Supervisor::ended(Process& process, std::string how) {
  if (loop_.now() - process.started >= options_.well_after) process.back_off.reset();
  process.child.reset();
  process.status.pid = 0;
  process.status.last_end = std::move(how);
  process.status.state = is_stopping_ ? ProcessStatus::State::ended : ProcessStatus::State::waits_to_start;
  if (is_stopping_) {
    log_.info(fmt::format("{} {}", process.spec.name, process.status.last_end));
    return tell();
  }
  auto const wait = process.back_off.wait();
  process.next_start = loop_.now() + wait;
  ++process.status.restarts;
  log_.error(fmt::format("{} {}; it is started again in {:.1f} s", process.spec.name, process.status.last_end,
                         base::to_seconds(wait)));
  tell();
}

void Supervisor::end_by_force(Process& process, std::string const& why) {
  log_.error(fmt::format("{} {}: it is ended by force", process.spec.name, why));
  process.child->signal(SIGKILL);
  lived(process);  // that takes effect at once
}

void Supervisor::look_after(Process& process) {
  if (!process.child) {
    if (!is_stopping_ && loop_.now() >= process.next_start) start(process);
    return;
  }
  if (process.child->has_lived()) lived(process);
  if (auto const change = process.child->look()) {
    auto const how = onboard::to_string(*change);
    if (change->kind == ChildChange::Kind::stopped) return end_by_force(process, how);
    return ended(process, how);
  }
  if (process.spec.tells_life) judge_silence(process);
}

void Supervisor::lived(Process& process) const {
  process.lived = loop_.now();
  process.waited = process.child->waited().value_or(base::Duration::zero());
}

void Supervisor::judge_silence(Process& process) {
  auto const silence = loop_.now() - process.lived;
  if (silence <= options_.longest_silence) return;
  auto const waited = process.child->waited().value_or(base::Duration::zero()) - process.waited;
  if (silence - waited > options_.longest_silence)
    return end_by_force(process, fmt::format("hangs: it has said nothing for {:.1f} s", base::to_seconds(silence)));
  if (!std::exchange(process.is_starved, true))
    log_.warn(fmt::format("{} waits for a processor: this computer has too much to do", process.spec.name));
}

void Supervisor::stop(std::function<void()> done) {
  if (std::exchange(is_stopping_, true)) return;
  scope_.spawn(end_all(std::move(done)));
}

base::Task<> Supervisor::end_all(std::function<void()> done) {
  for (auto& process : std::views::reverse(processes_)) {
    if (!process.child) continue;
    process.child->signal(SIGTERM);
    auto const deadline = loop_.now() + options_.stop_patience;
    while (process.child && loop_.now() < deadline) co_await loop_.sleep(look_period);
    if (process.child) end_by_force(process, "has not ended when it was told to");
    while (process.child) co_await loop_.sleep(look_period);
  }
  done();
}

}  // namespace lapwing::onboard
