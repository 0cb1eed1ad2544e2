#include "vehicle/joined/joined_control.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/wall_clock.hpp"
#include "vehicle/joined/shared_id.hpp"

namespace lapwing::vehicle {

using base::ErrorKind;
using base::fail;
using base::Result;

namespace {

CommandOutcome* outcome_of(CommandRecord& record, VehicleId const& id) {
  auto const found = std::ranges::find(record.outcomes, id, &CommandOutcome::vehicle);
  return found == record.outcomes.end() ? nullptr : &*found;
}

CommandRecord const* record_of(VehicleControl const& control, std::uint64_t number) {
  auto const found = std::ranges::find(control.commands(), number, &CommandRecord::number);
  return found == control.commands().end() ? nullptr : &*found;
}

}  // namespace

std::vector<JoinedControl::Member const*> JoinedControl::owners(VehicleId const& id) const {
  std::vector<Member const*> found;
  for (auto const& member : members_)
    if (member.control->has(id)) found.push_back(&member);
  return found;
}

Result<VehicleControl*> JoinedControl::owner(VehicleId const& id) const {
  if (is_alone()) return members_.front().control;  // it says itself what it has not
  auto const found = owners(id);
  if (found.empty()) return fail(ErrorKind::not_found, fmt::format("there is no vehicle {}", id.text));
  if (found.size() > 1) return fail(ErrorKind::refused, shared_id(found, id));
  return found.front()->control;
}

// ---- commands

Result<std::uint64_t> JoinedControl::command(VehicleCommand command, std::span<VehicleId const> vehicles, Commander by,
                                             bool takes_over) {
  if (is_alone()) return members_.front().control->command(std::move(command), vehicles, std::move(by), takes_over);
  if (vehicles.empty()) return fail(ErrorKind::invalid_input, "no vehicle was named to command");
  (void)commands();  // what is over may be forgotten, there and then here
  CommandRecord record{.number = last_number_ + 1, .command = command, .by = by, .asked = base::wall_now()};
  std::map<VehicleControl*, std::vector<VehicleId>> shares;
  for (auto const& id : vehicles) {
    if (outcome_of(record, id)) continue;
    auto const found = owner(id);
    record.outcomes.push_back({.vehicle = id});
    if (!found) record.outcomes.back() = {id, CommandState::refused, found.error().message, {}};
    if (found) shares[*found].push_back(id);
  }
  std::vector<Part> parts;
  std::optional<base::Error> refusal;
  for (auto const& member : members_) {
    auto const share = shares.find(member.control);
    if (share == shares.end()) continue;
    auto const number = member.control->command(command, share->second, by, takes_over);
    if (number) parts.push_back({member.control, *number});
    if (number) continue;
    refusal = number.error();
    for (auto const& id : share->second)
      *outcome_of(record, id) = {id, CommandState::refused, number.error().message, {}};
  }
  // What is wrong with the command itself is its giver's to mend, and no record.
  if (refusal && parts.empty()) return std::unexpected(*std::move(refusal));
  make_room(records_);
  std::erase_if(parts_, [this](auto const& entry) {
    return std::ranges::find(records_, entry.first, &CommandRecord::number) == records_.end();
  });
  parts_[record.number] = std::move(parts);
  records_.push_back(std::move(record));
  return ++last_number_;
}

std::deque<CommandRecord> const& JoinedControl::commands() const {
  if (is_alone()) return members_.front().control->commands();
  for (auto& record : records_) {
    for (auto const& [control, number] : parts_.at(record.number)) {
      auto const* part = record_of(*control, number);  // null: forgotten there, and so at its end
      for (auto const& outcome : part ? part->outcomes : std::vector<CommandOutcome>())
        *outcome_of(record, outcome.vehicle) = outcome;
    }
  }
  return records_;
}

// ---- emergency stop

void JoinedControl::emergency_stop(std::optional<StopAction> action, Commander by) {
  for (auto const& member : members_) member.control->emergency_stop(action, by);
}

void JoinedControl::release_emergency_stop(Commander by) {
  for (auto const& member : members_) member.control->release_emergency_stop(by);
}

EmergencyStop const& JoinedControl::emergency() const {
  if (is_alone()) return members_.front().control->emergency();
  EmergencyStop all;
  for (auto const& member : members_) {
    auto const& one = member.control->emergency();
    auto vehicles = std::move(all.vehicles);
    vehicles.insert(vehicles.end(), one.vehicles.begin(), one.vehicles.end());
    if (one.is_latched && !all.is_latched) all = one;
    if (!all.is_latched && all.by.empty()) all = one;  // the last one, until there is another
    all.vehicles = std::move(vehicles);
  }
  stop_ = std::move(all);
  return stop_;
}

// ---- who is in command

Result<> JoinedControl::request_control(VehicleId const& id, Commander by) {
  auto const found = owner(id);
  return found ? (*found)->request_control(id, std::move(by)) : Result<>(std::unexpected(found.error()));
}

Result<> JoinedControl::yield_control(VehicleId const& id, Commander by) {
  auto const found = owner(id);
  return found ? (*found)->yield_control(id, std::move(by)) : Result<>(std::unexpected(found.error()));
}

Result<> JoinedControl::keep_control(VehicleId const& id, Commander by) {
  auto const found = owner(id);
  return found ? (*found)->keep_control(id, std::move(by)) : Result<>(std::unexpected(found.error()));
}

void JoinedControl::forget(Commander const& by) {
  for (auto const& member : members_) member.control->forget(by);
}

std::uint64_t JoinedControl::revision() const {
  auto revision = is_alone() ? 0 : last_number_;  // a command that was refused to every vehicle is known here alone
  for (auto const& member : members_) revision += member.control->revision();
  return revision;
}

}  // namespace lapwing::vehicle
