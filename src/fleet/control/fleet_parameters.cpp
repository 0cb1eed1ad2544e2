#include "fleet/control/fleet_parameters.hpp"

#include <utility>

#include <fmt/format.h>

#include "parameters/parameter_file.hpp"

namespace lapwing::fleet {

using base::ErrorKind;
using base::fail;
using base::Result;
using parameters::Wanted;
using vehicle::Commander;
using vehicle::VehicleId;

namespace {

vehicle::Parameter shown(mavlink::Parameter const& parameter) {
  return {parameter.name, parameter.value, mavlink::to_string(parameter.type)};
}

parameters::FileHeader header_of(MavlinkVehicle const& craft, parameters::Identity const& identity) {
  parameters::FileHeader header{.system_id = craft.address.system};
  if (craft.state.autopilot == vehicle::Autopilot::ardupilot) header.stack = "ArduPilot";
  if (craft.state.autopilot == vehicle::Autopilot::px4) header.stack = "PX4";
  header.vehicle = to_string(craft.state.family);
  if (identity.firmware != 0) header.version = parameters::firmware_text(identity.firmware);
  return header;
}

}  // namespace

/// The command of a vehicle for as long as one change lasts: it is given back if nobody had it before, so that a value
/// set in passing keeps no script from the vehicle.
class FleetParameters::Loan {
 public:
  Loan(FleetParameters& owner, MavlinkVehicle& craft, Commander by, bool is_lent)
      : owner_(owner), craft_(craft), by_(std::move(by)), is_lent_(is_lent) {
    if (is_lent_) ++loans();
  }
  Loan(Loan const&) = delete;
  Loan& operator=(Loan const&) = delete;
  ~Loan() {
    // None left although this one goes on: its holder has commanded the vehicle since, and keeps it.
    if (!is_lent_ || loans() == 0) return;
    --loans();
    if (loans() > 0) return;
    (void)owner_.fleet_.authority().yield(craft_.id(), by_);
  }

 private:
  int& loans() { return craft_.runs.write(As<FleetParameters>()).loans; }

  FleetParameters& owner_;
  MavlinkVehicle& craft_;
  Commander by_;
  bool is_lent_;
};

FleetParameters::FleetParameters(Fleet& fleet, parameters::Cache cache, base::Logger log)
    : fleet_(fleet), cache_(std::move(cache)), log_(log.named("parameters")), scope_(fleet.loop()) {
  // A service knows the vehicles that it has heard, so it begins with its network's first message.
  subscription_ = fleet.subscribe(
      [this](Network const& network, mavlink::Received const&) { (void)service_of(network.connection()); });
}

parameters::ParameterService& FleetParameters::service_of(mavlink::Connection& connection) {
  return services_.try_emplace(&connection, connection, cache_, log_).first->second;
}

Result<MavlinkVehicle*> FleetParameters::find(VehicleId const& id) const {
  auto* const craft = fleet_.find(id);
  if (!craft) return fail(ErrorKind::not_found, fmt::format("there is no vehicle {}", id.text));
  if (craft->state.links.connection == vehicle::Connection::lost)
    return fail(ErrorKind::lost, fmt::format("{} is not heard", craft->state.name), "ask again when it is back");
  return craft;
}

// ---- all of them

base::Task<FleetParameters::Snapshot> FleetParameters::snapshot(VehicleId id, bool old_ones_do) {
  auto const craft = find(id);
  if (!craft) co_return std::unexpected(craft.error());
  // What may bring old values is no answer to who wants the vehicle's own: that comes after it.
  auto const is_too_little = [&] {
    auto const running = fetches_.find(id);
    return !old_ones_do && running != fetches_.end() && running->second->wanted == Wanted::cached_too;
  };
  while (is_too_little()) {
    auto const running = fetches_.at(id);
    co_await running->ended.wait();
  }
  auto const running = fetches_.find(id);
  bool const is_first = running == fetches_.end();
  auto const wanted = old_ones_do ? Wanted::cached_too : Wanted::confirmed;
  auto const joined = is_first ? std::make_shared<Fetch>(fleet_.loop(), wanted) : running->second;
  if (is_first) {
    fetches_[id] = joined;
    scope_.spawn(fetch(**craft, joined));
  }
  while (!joined->result) co_await joined->ended.wait();
  co_return *joined->result;
}

/// Goes on when who asked has gone: others may have joined, and the cache is the better for it.
base::Task<> FleetParameters::fetch(MavlinkVehicle& craft, std::shared_ptr<Fetch> into) {
  mavlink::ParamProgress const note = [into = into.get()](std::size_t done, std::size_t total) {
    into->progress = {done, total};
  };
  auto const system_id = craft.address.system;
  into->result = co_await service_of(craft.connection).all(system_id, into->wanted, note);
  fetches_.erase(craft.id());
  into->ended.notify_all();
}

base::Task<Result<vehicle::ParameterList>> FleetParameters::all(VehicleId id, bool old_ones_do) {
  auto const got = co_await snapshot(id, old_ones_do);
  if (!got) co_return std::unexpected(got.error());
  vehicle::ParameterList list{.parameters = {}, .taken = got->taken, .confirmed = got->confirmed};
  for (auto const& parameter : got->parameters) list.parameters.push_back(shown(parameter));
  co_return list;
}

std::optional<vehicle::ParameterProgress> FleetParameters::progress(VehicleId const& id) const {
  auto const running = fetches_.find(id);
  return running == fetches_.end() ? std::nullopt : std::optional(running->second->progress);
}

base::Task<Result<std::string>> FleetParameters::file(VehicleId id, bool old_ones_do) {
  auto const got = co_await snapshot(id, old_ones_do);
  if (!got) co_return std::unexpected(got.error());
  auto const header = header_of(*fleet_.find(id), got->identity);
  co_return parameters::qgroundcontrol_text(got->parameters, header);
}

// ---- one of them

base::Task<Result<vehicle::Parameter>> FleetParameters::read(VehicleId id, std::string name) {
  auto const craft = find(id);
  if (!craft) co_return std::unexpected(craft.error());
  auto const system_id = (*craft)->address.system;
  auto const value = co_await service_of((*craft)->connection).read(system_id, name);
  if (!value) co_return std::unexpected(value.error());
  co_return shown(*value);
}

base::Task<Result<vehicle::ParameterChange>> FleetParameters::change(VehicleId id, std::string name, double value,
                                                                     Commander by) {
  auto const found = find(id);
  if (!found) co_return std::unexpected(found.error());
  auto& craft = **found;
  bool const is_lent = craft.state.control.commander.empty() || craft.runs->loans > 0;
  if (auto const claimed = fleet_.authority().claim(craft.id(), by); !claimed)
    co_return std::unexpected(claimed.error());
  Loan const loan(*this, craft, by, is_lent);
  auto const system_id = craft.address.system;
  auto const changed = co_await service_of(craft.connection).change(system_id, name, value);
  if (!changed) {
    log_.warn(
        fmt::format("{} could not set {} of {} to {}: {}", by, name, craft.state.name, value, changed.error().message));
    co_return std::unexpected(changed.error());
  }
  log_.info(fmt::format("{} set {} of {} to {} (was {})", by, name, craft.state.name,
                        mavlink::value_text(changed->after), mavlink::value_text(changed->before)));
  co_return vehicle::ParameterChange{shown(changed->before), shown(changed->after)};
}

}  // namespace lapwing::fleet
