#include "fleet/alarms/alarms.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/wall_clock.hpp"

namespace lapwing::fleet {

using vehicle::Alarm;
using vehicle::AlarmKind;
using vehicle::VehicleState;

namespace {

constexpr base::Duration looks_every = std::chrono::milliseconds(250);

/// Whether other words are other news, and not the same told of another moment.
bool words_are_news(AlarmKind kind) {
  return kind == AlarmKind::failsafe || kind == AlarmKind::foreign_mode || kind == AlarmKind::fence;
}

bool is_same(Alarm const& alarm, Condition const& condition) {
  return alarm.kind == condition.kind && (!words_are_news(alarm.kind) || alarm.words == condition.words);
}

bool is_link(AlarmKind kind) {
  return kind == AlarmKind::silent || kind == AlarmKind::lost || kind == AlarmKind::conflict;
}

bool is_battery(AlarmKind kind) {
  return kind == AlarmKind::battery_low || kind == AlarmKind::battery_critical;
}

/// It is worse or better than before, but not over.
bool is_about_the_same(AlarmKind before, AlarmKind now) {
  return before == now || (is_link(before) && is_link(now)) || (is_battery(before) && is_battery(now));
}

}  // namespace

Alarms::Alarms(base::Loop& loop, vehicle::Registry const& registry, vehicle::BatteryLimits limits, base::Logger log)
    : loop_(loop), registry_(registry), limits_(limits), log_(log), roll_call_(std::move(log)), watch_(watch()) {
  watch_.start();
}

std::size_t Alarms::acknowledge(std::span<std::uint64_t const> numbers, vehicle::Commander by) {
  std::size_t count = 0;
  for (auto& [id, watched] : watched_) {
    for (auto& alarm : watched.alarms) {
      if (!alarm.acknowledged_by.empty() || std::ranges::find(numbers, alarm.number) == numbers.end()) continue;
      alarm.acknowledged_by = by;
      ++count;
    }
  }
  if (count == 0) return 0;
  publish();
  log_.info(fmt::format("{} acknowledged {} alarm{}", by, count, count == 1 ? "" : "s"));
  return count;
}

base::Task<> Alarms::watch() {
  for (;;) {
    (void)co_await registry_.membership_changed().wait_until(loop_.now() + looks_every);
    bool is_news = false;
    for (auto const* state : registry_.all())
      if (look_at(*state, watched_[state->id])) is_news = true;
    if (is_news) publish();
    roll_call_.flush(loop_.now());
  }
}

bool Alarms::look_at(VehicleState const& state, Watched& watched) {
  note_commander(state, watched);
  auto& alarms = watched.alarms;
  std::vector<AlarmKind> standing;
  for (auto const& alarm : alarms) standing.push_back(alarm.kind);
  auto conditions = conditions_of(state, {limits_, standing, watched.left_at}, loop_.now());
  // What has its alarm already leaves the conditions, what is true no longer leaves the alarms; the rest is new.
  auto const is_over = [&](Alarm const& alarm) {
    if (std::erase_if(conditions, [&](Condition const& condition) { return is_same(alarm, condition); }) > 0)
      return false;
    auto const follows = [&](Condition const& condition) { return is_about_the_same(alarm.kind, condition.kind); };
    if (std::ranges::none_of(conditions, follows)) say_ended(state, alarm);
    return true;
  };
  bool const have_ended = std::erase_if(alarms, is_over) > 0;
  for (auto& condition : conditions) alarms.push_back(raised(state, std::move(condition)));
  return have_ended || !conditions.empty();
}

void Alarms::note_commander(VehicleState const& state, Watched& watched) const {
  bool const has_commander = !state.control.commander.empty();
  bool const is_armed = state.arming.armed.value.value_or(false);
  if (has_commander || !is_armed)
    watched.left_at.reset();
  else if (watched.had_commander)
    watched.left_at = loop_.now();
  watched.had_commander = has_commander;
}

Alarm Alarms::raised(VehicleState const& state, Condition condition) {
  Alarm alarm{.number = ++last_number_,
              .kind = condition.kind,
              .severity = condition.severity,
              .vehicle = state.id,
              .name = state.name,
              .words = std::move(condition.words),
              .since = condition.since,
              .raised = base::wall_now()};
  roll_call_.begins(alarm);
  return alarm;
}

void Alarms::publish() {
  alarms_.clear();
  for (auto const& [id, watched] : watched_)
    alarms_.insert(alarms_.end(), watched.alarms.begin(), watched.alarms.end());
  std::ranges::sort(alarms_, {}, &Alarm::number);
  ++revision_;
}

void Alarms::say_ended(VehicleState const& state, Alarm const& alarm) {
  auto const lasted = base::to_seconds(loop_.now() - alarm.since);
  switch (alarm.kind) {
    case AlarmKind::silent:
      return roll_call_.ends(alarm, fmt::format("{} is heard again after {:.0f} s", state.name, lasted));
    case AlarmKind::lost: return roll_call_.ends(alarm, fmt::format("{} is back at {}", state.name, state.links.used));
    case AlarmKind::conflict: return roll_call_.ends(alarm, fmt::format("{} has its id for itself", state.name));
    default: return roll_call_.ends(alarm, fmt::format("over: {}", alarm.words));
  }
}

}  // namespace lapwing::fleet
