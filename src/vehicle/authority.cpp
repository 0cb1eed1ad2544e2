#include "vehicle/authority.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::vehicle {

using base::ErrorKind;
using base::fail;
using base::Result;

namespace {

std::unexpected<base::Error> unknown(VehicleId const& id) {
  return fail(ErrorKind::not_found, fmt::format("there is no vehicle {}", id.text));
}

}  // namespace

VehicleState* Authority::find(VehicleId const& id) {
  return registry_.find(id) ? &registry_.edit(id) : nullptr;
}

Result<> Authority::claim(VehicleId const& id, Commander const& by) {
  if (barred_) return fail(ErrorKind::refused, *barred_);
  auto* const vehicle = find(id);
  if (!vehicle) return unknown(id);
  auto const& has = vehicle->control.commander;
  if (has == by) return {};
  if (!has.empty())
    return fail(ErrorKind::refused, fmt::format("{} is commanded by {}", vehicle->name, has),
                "ask for the command of it, or take it over");
  give(*vehicle, by);
  return {};
}

void Authority::take(VehicleId const& id, Commander const& by) {
  auto* const vehicle = find(id);
  if (!vehicle) return;
  auto const before = vehicle->control.commander;
  if (before == by) return;
  give(*vehicle, by);
  if (before.empty()) return;
  for (auto const& on_loss : on_loss_) on_loss(id, by);
}

bool Authority::yield(VehicleId const& id, Commander const& by) {
  auto* const vehicle = find(id);
  if (!vehicle || vehicle->control.commander != by) return false;
  auto const next = vehicle->control.asked_for_by;
  give(*vehicle, next);
  return true;
}

void Authority::forget(VehicleId const& id, Commander const& by) {
  auto* const vehicle = find(id);
  if (vehicle && !by.empty() && vehicle->control.asked_for_by == by) {
    vehicle->control.asked_for_by.clear();
    registry_.touch(id);
  }
  (void)yield(id, by);
}

bool Authority::keep(VehicleId const& id, Commander const& by) {
  auto* const vehicle = find(id);
  if (!vehicle || vehicle->control.commander != by) return false;
  auto& asked_for_by = vehicle->control.asked_for_by;
  if (!asked_for_by.empty())
    log_.info(fmt::format("{} stays with {}: {} was refused", vehicle->name, by, asked_for_by));
  asked_for_by.clear();
  registry_.touch(id);
  return true;
}

Result<> Authority::request(VehicleId const& id, Commander by, base::Duration timeout) {
  auto* const vehicle = find(id);
  if (!vehicle) return unknown(id);
  auto& control = vehicle->control;
  if (control.commander.empty() || control.commander == by) return claim(id, by);
  if (control.asked_for_by == by) return {};
  if (!control.asked_for_by.empty())
    return fail(ErrorKind::refused, fmt::format("{} asks for {} already", control.asked_for_by, vehicle->name));
  log_.info(fmt::format("{} asks {} for {}", by, control.commander, vehicle->name));
  control.asked_for_by = by;
  control.granted_at = loop_.now() + timeout;
  registry_.touch(id);
  scope_.spawn(grant_later(id, std::move(by), control.granted_at));
  return {};
}

void Authority::give(VehicleState& vehicle, Commander const& to) {
  vehicle.control = {.commander = to};
  registry_.touch(vehicle.id);
  log_.info(to.empty() ? fmt::format("{} is commanded by nobody", vehicle.name)
                       : fmt::format("{} is commanded by {}", vehicle.name, to));
}

base::Task<> Authority::grant_later(VehicleId id, Commander by, base::TimePoint at) {
  co_await loop_.sleep_until(at);
  auto const* const vehicle = registry_.find(id);
  // A request that was answered, or made anew since, is not this one.
  if (vehicle && vehicle->control.asked_for_by == by && vehicle->control.granted_at == at) take(id, by);
}

}  // namespace lapwing::vehicle
