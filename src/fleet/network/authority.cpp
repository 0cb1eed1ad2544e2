#include "fleet/network/authority.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::fleet {

using base::ErrorKind;
using base::fail;
using base::Result;
using vehicle::Commander;

Result<> Authority::claim(MavlinkVehicle& craft, Commander const& by) {
  if (barred_) return fail(ErrorKind::refused, *barred_);
  auto const& has = craft.state.control.commander;
  if (has == by) return {};
  if (!has.empty())
    return fail(ErrorKind::refused, fmt::format("{} is commanded by {}", craft.state.name, has),
                "ask for the command of it, or take it over");
  give(craft, by);
  return {};
}

void Authority::take(MavlinkVehicle& craft, Commander const& by) {
  auto const before = craft.state.control.commander;
  if (before == by) return;
  give(craft, by);
  if (!before.empty() && on_loss_) on_loss_(craft, by);
}

bool Authority::yield(MavlinkVehicle& craft, Commander const& by) {
  auto const& control = craft.state.control;
  if (control.commander != by) return false;
  auto const next = control.asked_for_by;
  give(craft, next);
  return true;
}

void Authority::forget(MavlinkVehicle& craft, Commander const& by) {
  auto& control = craft.state.control;
  if (!by.empty() && control.asked_for_by == by) {
    control.asked_for_by.clear();
    registry_.touch(craft.id());
  }
  (void)yield(craft, by);
}

bool Authority::keep(MavlinkVehicle& craft, Commander const& by) {
  auto& control = craft.state.control;
  if (control.commander != by) return false;
  if (!control.asked_for_by.empty())
    log_.info(fmt::format("{} stays with {}: {} was refused", craft.state.name, by, control.asked_for_by));
  control.asked_for_by.clear();
  registry_.touch(craft.id());
  return true;
}

Result<> Authority::request(MavlinkVehicle& craft, Commander by, base::Duration timeout) {
  auto& control = craft.state.control;
  if (control.commander.empty() || control.commander == by) return claim(craft, by);
  if (control.asked_for_by == by) return {};
  if (!control.asked_for_by.empty())
    return fail(ErrorKind::refused, fmt::format("{} asks for {} already", control.asked_for_by, craft.state.name));
  log_.info(fmt::format("{} asks {} for {}", by, control.commander, craft.state.name));
  control.asked_for_by = by;
  control.granted_at = loop_.now() + timeout;
  registry_.touch(craft.id());
  scope_.spawn(grant_later(craft, std::move(by), control.granted_at));
  return {};
}

void Authority::give(MavlinkVehicle& craft, Commander const& to) {
  craft.state.control = {.commander = to};
  registry_.touch(craft.id());
  log_.info(to.empty() ? fmt::format("{} is commanded by nobody", craft.state.name)
                       : fmt::format("{} is commanded by {}", craft.state.name, to));
}

base::Task<> Authority::grant_later(MavlinkVehicle& craft, Commander by, base::TimePoint at) {
  co_await loop_.sleep_until(at);
  auto const& control = craft.state.control;
  // A request that was answered, or made anew since, is not this one.
  if (control.asked_for_by == by && control.granted_at == at) take(craft, by);
}

}  // namespace lapwing::fleet
