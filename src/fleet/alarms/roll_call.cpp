#include "fleet/alarms/roll_call.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

namespace lapwing::fleet {

namespace {

constexpr base::Duration gathers_for = std::chrono::seconds(1);
constexpr std::size_t most_named = 3;

/// "copter 1, copter 2, copter 3 and 247 more".
template <class Entries>
std::string names_of(Entries const& entries) {
  std::string names;
  auto const shown = std::min(entries.size(), most_named);
  for (std::size_t i = 0; i < shown; ++i) names += (i == 0 ? "" : ", ") + entries[i].name;
  return entries.size() == shown ? names : fmt::format("{} and {} more", names, entries.size() - shown);
}

}  // namespace

void RollCall::flush(base::TimePoint now) {
  for (auto& [subject, entries] : waiting_) {
    if (entries.empty()) continue;
    auto const last = written_.find(subject);
    if (last != written_.end() && now - last->second < gathers_for) continue;
    written_[subject] = now;
    write(subject, entries);
    entries.clear();
  }
}

void RollCall::write(Subject subject, std::vector<Entry> const& entries) const {
  auto const [kind, begins] = subject;
  auto line = entries.size() == 1 ? entries.front().words
                                  : fmt::format("{} vehicles {}{}: {}", entries.size(), begins ? "" : "no longer ",
                                                vehicle::words_for_many(kind), names_of(entries));
  auto const is_critical = [](Entry const& entry) { return entry.severity == vehicle::Severity::critical; };
  if (!begins) return log_.info(std::move(line));
  std::ranges::any_of(entries, is_critical) ? log_.error(std::move(line)) : log_.warn(std::move(line));
}

}  // namespace lapwing::fleet
