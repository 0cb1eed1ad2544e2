#include "tasks/platforms.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tasks/failed_run.hpp"
#include "vehicle/joined/shared_id.hpp"

namespace lapwing::tasks {

using base::ErrorKind;
using base::fail;
using base::Result;

Result<> Platforms::add(std::string name, Platform& platform) {
  auto joined = vocabulary_;
  if (auto fits = join(joined, platform.vocabulary()); !fits) {
    auto const& [kind, what, hint] = fits.error();
    return fail(kind, fmt::format("{} does not go with the platforms before it: {}", name, what), hint);
  }
  auto const known = plan_names();
  for (auto const& plan : platform.plan_names()) {
    if (std::ranges::find(known, plan) == known.end()) continue;
    return fail(ErrorKind::invalid_input, fmt::format("{} has a plan '{}', as another platform has", name, plan),
                "give one of the two another name");
  }
  vocabulary_ = std::move(joined);
  members_.push_back({std::move(name), &platform});
  scope_.spawn(pass_on(platform));
  look_for_conflicts();
  return {};
}

// ---- words and plans

Result<std::shared_ptr<PlatformTask const>> Platforms::named_task(std::string_view name) const {
  std::optional<base::Error> first;
  for (auto const& member : members_) {
    auto task = member.platform->named_task(name);
    // One that is there and cannot be read is the answer, too.
    if (task || task.error().kind != ErrorKind::not_found) return task;
    if (!first) first = std::move(task.error());
  }
  if (!first) return fail(ErrorKind::not_found, fmt::format("there is no plan called '{}'", name));
  return std::unexpected(*std::move(first));
}

std::vector<std::string> Platforms::plan_names() const {
  std::vector<std::string> names;
  for (auto const& member : members_) std::ranges::move(member.platform->plan_names(), std::back_inserter(names));
  return names;
}

// ---- vehicles

std::vector<Platforms::Member const*> Platforms::owners(VehicleId const& id) const {
  std::vector<Member const*> found;
  for (auto const& member : members_)
    if (member.platform->find(id)) found.push_back(&member);
  return found;
}

Result<Platform*> Platforms::owner(VehicleId const& id) const {
  auto const found = owners(id);
  if (found.empty()) return fail(ErrorKind::lost, fmt::format("no vehicle {}", id.text));
  if (found.size() > 1) return fail(ErrorKind::refused, vehicle::shared_id(found, id));
  return found.front()->platform;
}

std::vector<VehicleInfo> Platforms::vehicles() const {
  std::vector<VehicleInfo> all;
  for (auto const& member : members_) {
    for (auto& info : member.platform->vehicles()) {
      if (std::ranges::find(all, info.id, &VehicleInfo::id) != all.end()) continue;
      if (auto const found = members_.size() > 1 ? find(info.id) : std::nullopt) info = *found;
      all.push_back(std::move(info));
    }
  }
  return all;
}

std::optional<VehicleInfo> Platforms::find(VehicleId const& id) const {
  auto const found = owners(id);
  if (found.empty()) return std::nullopt;
  auto info = found.front()->platform->find(id);
  if (found.size() == 1 || !info) return info;
  info->connected = false;
  info->conflict = vehicle::shared_id(found, id);
  return info;
}

base::Notifier& Platforms::vehicles_changed() {
  return members_.size() == 1 ? members_.front().platform->vehicles_changed() : changed_;
}

base::Task<> Platforms::pass_on(Platform& from) {
  for (;;) {
    co_await from.vehicles_changed().wait();
    look_for_conflicts();
    changed_.notify_all();
  }
}

/// Tells each once, and when it is over.
void Platforms::look_for_conflicts() {
  if (members_.size() < 2) return;
  std::set<VehicleId> now;
  for (auto const& info : vehicles()) {
    if (info.conflict.empty()) continue;
    now.insert(info.id);
    if (!in_conflict_.contains(info.id))
      log_.error(fmt::format("{}: neither is commanded until one of them has another id", info.conflict));
  }
  for (auto const& id : in_conflict_)
    if (!now.contains(id)) log_.info(fmt::format("there is one vehicle {} again", id.text));
  in_conflict_ = std::move(now);
}

base::TimePoint Platforms::all_heard_by() const {
  base::TimePoint latest{};
  for (auto const& member : members_) latest = std::max(latest, member.platform->all_heard_by());
  return latest;
}

void Platforms::set_connection_timeout(VehicleId const& id, base::Duration timeout) {
  for (auto const* member : owners(id)) member->platform->set_connection_timeout(id, timeout);
}

// ---- what vehicles do

Result<> Platforms::perform(InstructionCall const& call, VehicleId const& id) {
  auto const found = owner(id);
  return found ? (*found)->perform(call, id) : Result<>(std::unexpected(found.error()));
}

std::optional<std::string> Platforms::unsuited(PlatformTask const& task, VehicleInfo const& vehicle) const {
  auto const found = owner(vehicle.id);
  return found ? (*found)->unsuited(task, vehicle) : std::optional(found.error().message);
}

std::unique_ptr<TaskRun> Platforms::start(std::shared_ptr<PlatformTask const> task, VehicleId const& id) {
  auto const found = owner(id);
  if (!found) return std::make_unique<FailedRun>(found.error().message, true);
  return (*found)->start(std::move(task), id);
}

base::Task<void> Platforms::settle() {
  // By then all have been told to stop: that they are waited for one after the other takes no longer.
  for (auto const& member : members_) {
    auto settling = member.platform->settle();
    co_await settling;
  }
}

}  // namespace lapwing::tasks
