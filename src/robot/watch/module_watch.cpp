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

}  // namespace

ModuleWatch::ModuleWatch(WatchSettings settings) : settings_(std::move(settings)) {}

void ModuleWatch::report(Module module, ModuleReport const& report, base::TimePoint now) {
  auto& entry = entries_[static_cast<std::size_t>(module)];
  entry.report = report;
  entry.heard.push_back(now);
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
    if (auto const no = objection(module, now)) return *no;
  return {.may_move = true, .who = std::nullopt, .reason = {}, .what_to_do = {}};
}

std::optional<Clearance> ModuleWatch::objection(Module module, base::TimePoint now) const {
  auto const no = [&](std::string reason, std::string what_to_do) {
    return Clearance{
        .may_move = false, .who = module, .reason = std::move(reason), .what_to_do = std::move(what_to_do)};
  };
  auto const& [report, heard] = entry(module);
  if (!report) return no(fmt::format("{} has not started", full_name(module)), "wait, or see its log");
  if (auto const silent = now - heard.back(); silent > settings_.silence)
    return no(fmt::format("{} has been silent for {:.1f} s", full_name(module), base::to_seconds(silent)),
              "it is started anew by itself; if it stays away, see its log");
  auto const* const code = find_code(report->error_code);
  if (report->error_code != code::none && severity_of(report->error_code) == Severity::critical)
    return no(fmt::format("{} reports error {}: {}", full_name(module), report->error_code,
                          code != nullptr ? code->meaning : "none that this program knows"),
              std::string(code != nullptr ? code->what_to_do : "bring all parts to the same version"));
  if (report->state == ModuleState::failed)
    return no(fmt::format("{} has failed", full_name(module)), "see its log, and start it anew");
  if (report->state != ModuleState::ready) return no(fmt::format("{} is not ready yet", full_name(module)), "wait");
  return std::nullopt;
}

std::vector<ModuleHealth> ModuleWatch::health(base::TimePoint now) const {
  std::vector<ModuleHealth> all;
  for (auto const& name : module_names) {
    auto const& [report, heard] = entry(name.module);
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
