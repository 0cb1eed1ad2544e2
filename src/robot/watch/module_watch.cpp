#include "robot/watch/module_watch.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "robot/watch/codes.hpp"

namespace lapwing::robot {

namespace {

using namespace std::chrono_literals;

/// Over which reports are counted.
base::Duration constexpr rate_window = 1s;
/// A module that reports a thousand times a second is counted to here.
std::size_t constexpr most_remembered = 256;

std::string full_name(Module module) {
  auto const& name = name_of(module);
  return fmt::format("{} ({})", name.name, name.short_name);
}

Clearance no(Module module, std::string reason, std::string what_to_do) {
  return {.may_move = false, .who = module, .reason = std::move(reason), .what_to_do = std::move(what_to_do)};
}

bool is_critical(ModuleReport const& report) {
  bool const has_error = report.error_code != code::none && severity_of(report.error_code) == Severity::critical;
  return has_error || report.state == ModuleState::failed;
}

}  // namespace

ModuleWatch::ModuleWatch(WatchSettings settings) : settings_(std::move(settings)) {}

void ModuleWatch::report(Module module, ModuleReport const& report, base::TimePoint now) {
  auto& entry = entries_[static_cast<std::size_t>(module)];
  entry.report = report;
  entry.heard.push_back(now);
  if (is_critical(report)) {
    entry.critical_at = now;
    entry.critical = report;
  }
  while (entry.heard.size() > most_remembered || now - entry.heard.front() > rate_window) entry.heard.pop_front();
}

base::Result<> ModuleWatch::restart(base::TimePoint now) {
  auto const modules = clearance_of_modules(now);
  if (!modules.may_move)
    return base::fail(base::ErrorKind::refused, fmt::format("the robot cannot be restarted yet: {}", modules.reason),
                      modules.what_to_do);
  is_killed_ = false;
  return {};
}

Clearance ModuleWatch::clearance(base::TimePoint now) const {
  if (is_killed_)
    return {.may_move = false,
            .who = std::nullopt,
            .reason = "the robot was killed",
            .what_to_do = "when it is safe to move, restart it at the command centre"};
  return clearance_of_modules(now);
}

Clearance ModuleWatch::clearance_of_modules(base::TimePoint now) const {
  for (auto const module : settings_.required)
    if (auto const objects = critical_objection(module, now)) return *objects;
  for (auto const module : settings_.required)
    if (auto const objects = objection(module, now)) return *objects;
  return {.may_move = true, .who = std::nullopt, .reason = {}, .what_to_do = {}};
}

std::optional<Clearance> ModuleWatch::critical_objection(Module module, base::TimePoint now) const {
  auto const& [report, heard, critical_at, critical] = entry(module);
  if (!critical_at || now - *critical_at >= settings_.calm) return std::nullopt;
  bool const is_over = !is_critical(*report);
  if (critical.error_code == code::none)
    return no(module, fmt::format("{} {}", full_name(module), is_over ? "had failed a moment ago" : "has failed"),
              "see its log, and start it anew");
  auto const* const entry = find_code(critical.error_code);
  return no(module,
            fmt::format("{} {} error {}: {}", full_name(module), is_over ? "reported a moment ago" : "reports",
                        critical.error_code, entry != nullptr ? entry->meaning : "none that this program knows"),
            std::string(entry != nullptr ? entry->what_to_do : "bring all parts to the same version"));
}

std::optional<Clearance> ModuleWatch::objection(Module module, base::TimePoint now) const {
  auto const& [report, heard, critical_at, critical] = entry(module);
  if (!report) return no(module, fmt::format("{} has not started", full_name(module)), "wait, or see its log");
  if (auto const silent = now - heard.back(); silent > settings_.silence)
    return no(module, fmt::format("{} has been silent for {:.1f} s", full_name(module), base::to_seconds(silent)),
              "it goes on by itself when the module is heard again; if it stays away, see its log");
  if (report->state != ModuleState::ready)
    return no(module, fmt::format("{} is not ready yet", full_name(module)), "wait");
  return std::nullopt;
}

std::vector<ModuleHealth> ModuleWatch::health(base::TimePoint now) const {
  std::vector<ModuleHealth> all;
  for (auto const& name : module_names) {
    auto const& [report, heard, critical_at, critical] = entry(name.module);
    ModuleHealth health;
    health.module = name.module;
    health.is_required = std::ranges::find(settings_.required, name.module) != settings_.required.end();
    if (report) {
      health.was_heard = true;
      health.report = *report;
      health.since_heard = now - heard.back();
      health.is_silent = health.since_heard > settings_.silence;
      auto const counted = std::ranges::count_if(heard, [&](auto at) { return now - at < rate_window; });
      health.reports_per_s = static_cast<double>(counted) / base::to_seconds(rate_window);
    }
    all.push_back(health);
  }
  return all;
}

}  // namespace lapwing::robot
