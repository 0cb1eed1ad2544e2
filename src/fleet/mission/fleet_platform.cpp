#include "fleet/mission/fleet_platform.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "fleet/actions/operator_actions.hpp"
#include "mavlink/wire/raw_message.hpp"
#include "missions/mission_task.hpp"
#include "missions/send_message.hpp"
#include "missions/vocabulary.hpp"
#include "tasks/failed_run.hpp"

namespace lapwing::fleet {

using base::ErrorKind;
using base::Result;
using tasks::RunState;
using tasks::VehicleInfo;
using vehicle::VehicleId;

namespace {

/// A run that is the pilot's.
class MissionTaskRun final : public tasks::TaskRun {
 public:
  MissionTaskRun(Pilot& pilot, OnStop on_stop, std::shared_ptr<RunRecord const> record)
      : pilot_(pilot), on_stop_(on_stop), record_(std::move(record)) {}

  [[nodiscard]] RunState state() const override {
    switch (record_->outcome) {
      case RunRecord::Outcome::running: return RunState::in_progress;
      case RunRecord::Outcome::done: return RunState::done;
      case RunRecord::Outcome::failed:
      case RunRecord::Outcome::stopped: return RunState::failed;
    }
    return RunState::failed;
  }
  [[nodiscard]] std::string error() const override { return record_->error; }
  [[nodiscard]] bool vehicle_failed() const override { return record_->vehicle_failed; }
  [[nodiscard]] std::string progress() const override { return record_->progress; }
  void stop() override { pilot_.stop(*record_, on_stop_); }

 private:
  Pilot& pilot_;
  OnStop on_stop_;
  std::shared_ptr<RunRecord const> record_;
};

VehicleInfo info_of(MavlinkVehicle const& craft) {
  auto const& state = craft.state;
  VehicleInfo info;
  info.id = state.id;
  info.type = craft.heard->type;
  info.payload = state.payload.names;
  info.connected = craft.is_connected();
  info.position = state.motion.position.value;
  if (state.power.battery.value) info.battery = state.power.battery.value->remaining;
  info.connection_timeout = craft.connection_timeout;
  info.battery_is_awaited = !craft.heard->has_reported_battery;
  info.mode = state.mode.value.value_or("");
  info.relative_alt_m = state.motion.relative_alt_m.value;
  return info;
}

/// When whatever was switched on together with the vehicle has been heard as well: they are chosen in the order of
/// their ids, not in that in which their first heartbeats happened to come.
base::TimePoint counted_at(MavlinkVehicle const& craft, std::vector<MavlinkVehicle*> const& all) {
  constexpr base::Duration heartbeats = std::chrono::milliseconds(1200);  // once a second
  auto last = craft.discovered;
  for (auto const* other : all)
    if (other->discovered - craft.discovered < heartbeats) last = std::max(last, other->discovered);
  return last + heartbeats;
}

/// Nothing for what no field of a message holds.
std::optional<mavlink::RawValue> raw_value(tasks::Argument const& value) {
  if (auto const* whole = std::get_if<std::int64_t>(&value)) return *whole;
  if (auto const* real = std::get_if<double>(&value)) return *real;
  if (auto const* text = std::get_if<std::string>(&value)) return *text;
  if (auto const* truth = std::get_if<bool>(&value)) return std::int64_t{*truth};
  return std::nullopt;
}

}  // namespace

/// Heartbeats come once a second and a position a second or two after it was asked for; some are lost.
constexpr base::Duration listening_time = std::chrono::seconds(5);

FleetPlatform::FleetPlatform(Fleet& fleet, Options options, base::Logger log)
    : fleet_(fleet),
      options_(std::move(options)),
      log_(std::move(log)),
      all_heard_by_(fleet.loop().now() + listening_time),
      settled_(fleet.loop()),
      vehicles_changed_(fleet.loop()),
      scope_(fleet.loop()) {
  scope_.spawn(tell_of_vehicles());
  vocabulary_ = missions::vocabulary(options_.run.plausibility);
  options_.run.neighbours = [this](MavlinkVehicle const& craft) { return neighbours(craft); };
}

Result<std::shared_ptr<tasks::PlatformTask const>> FleetPlatform::named_task(std::string_view name) const {
  return missions::find_plan(options_.plan_library, name);
}

std::vector<VehicleInfo> FleetPlatform::vehicles() const {
  std::vector<VehicleInfo> infos;
  auto const crafts = fleet_.all();
  auto const now = fleet_.loop().now();
  for (auto const* craft : crafts)
    if (now >= counted_at(*craft, crafts)) infos.push_back(info_of(*craft));
  return infos;
}

/// Also when a vehicle that was heard a while ago comes to count.
base::Task<void> FleetPlatform::tell_of_vehicles() {
  for (;;) {
    auto const crafts = fleet_.all();
    auto const now = fleet_.loop().now();
    auto next = base::TimePoint::max();
    for (auto const* craft : crafts)
      if (auto const at = counted_at(*craft, crafts); at > now) next = std::min(next, at);
    co_await fleet_.registry().membership_changed().wait_until(next);
    vehicles_changed_.notify_all();
  }
}

std::optional<VehicleInfo> FleetPlatform::find(VehicleId const& id) const {
  auto const* craft = fleet_.find(id);
  if (!craft) return std::nullopt;
  return info_of(*craft);
}

void FleetPlatform::set_connection_timeout(VehicleId const& id, base::Duration timeout) {
  fleet_.set_connection_timeout(id, timeout);
}

std::unique_ptr<tasks::TaskRun> FleetPlatform::start(std::shared_ptr<tasks::PlatformTask const> task,
                                                     VehicleId const& id) {
  auto* const craft = fleet_.find(id);
  if (!craft) return std::make_unique<tasks::FailedRun>(fmt::format("no vehicle {}", id.text));
  auto const* mission = dynamic_cast<missions::MissionTask const*>(task.get());
  if (!mission)
    return std::make_unique<tasks::FailedRun>(
        fmt::format("'{}' is no mission: {} cannot fly it", task->name(), craft->state.name));
  if (auto claimed = fleet_.authority().claim(id, vehicle::script_commander); !claimed)
    return std::make_unique<tasks::FailedRun>(claimed.error().message);
  auto& its_pilot = pilot(*craft);
  return std::make_unique<MissionTaskRun>(its_pilot, options_.run.on_stop, its_pilot.start(mission->mission()));
}

std::optional<std::string> FleetPlatform::unsuited(tasks::PlatformTask const& task, VehicleInfo const& vehicle) const {
  if (!dynamic_cast<missions::MissionTask const*>(&task)) return fmt::format("{} is no mission", task.name());
  return task.unsuited(vehicle);
}

Result<> FleetPlatform::perform(tasks::InstructionCall const& call, VehicleId const& id) {
  if (call.name != missions::send_message().name) return Platform::perform(call, id);
  return send_message(id, std::get<std::string>(call.arguments.front()), call.values);
}

Result<> FleetPlatform::send_message(VehicleId const& id, std::string_view message,
                                     std::span<tasks::NamedValue const> fields) {
  auto const* craft = fleet_.find(id);
  if (!craft) return base::fail(ErrorKind::lost, fmt::format("no vehicle {}", id.text));
  std::vector<mavlink::RawField> raw;
  for (auto const& [name, value] : fields) {
    auto converted = raw_value(value);
    if (!converted)
      return base::fail(ErrorKind::invalid_input, fmt::format("{}: {} takes a number or a text", message, name));
    raw.push_back({name, *std::move(converted)});
  }
  auto& connection = craft->connection;
  auto frame = mavlink::raw_message(message, raw, connection.self(), craft->address);
  if (!frame) return std::unexpected(frame.error());
  auto const& has = craft->state.control.commander;
  auto const known = mavlink::decode(*frame);
  if (!has.empty() && has != vehicle::script_commander && known && is_moving(*craft, *known))
    return base::fail(ErrorKind::refused, fmt::format("{} is commanded by {}", craft->state.name, has));
  auto sent = connection.send(craft->address, *frame);
  if (sent) log_.info(fmt::format("sent {} to {}", message, craft->state.name));
  return sent;
}

base::Task<void> FleetPlatform::settle() {
  auto const is_settling = [](auto const& entry) { return entry.second->is_settling(); };
  while (std::ranges::any_of(pilots_, is_settling)) co_await settled_.wait();
  for (auto& [id, its_pilot] : pilots_)
    if (!its_pilot->is_flying()) (void)fleet_.authority().yield(id, vehicle::script_commander);
}

void FleetPlatform::yield(VehicleId const& id, std::string const& reason) {
  if (auto const found = pilots_.find(id); found != pilots_.end()) found->second->yield(reason);
}

void FleetPlatform::yield_all(std::string const& reason) {
  for (auto& [id, its_pilot] : pilots_) its_pilot->yield(reason);
}

base::Task<void> FleetPlatform::make_safe(OnStop on_stop) {
  for (auto& [id, its_pilot] : pilots_) its_pilot->stop(on_stop);
  co_await settle();
}

std::vector<std::string> FleetPlatform::unsettled() const {
  std::vector<std::string> names;
  for (auto const& [id, its_pilot] : pilots_)
    if (its_pilot->is_settling()) names.push_back(fleet_.find(id)->state.name);
  return names;
}

std::vector<MissionReport> FleetPlatform::missions(VehicleId const& id) const {
  std::vector<MissionReport> reports;
  auto const found = pilots_.find(id);
  if (found == pilots_.end()) return reports;
  for (auto const& run : found->second->runs())
    reports.push_back({run->mission, run->items, base::to_seconds(run->upload.upload_time),
                       std::string(to_string(run->outcome)), run->error, run->flown});
  return reports;
}

std::vector<plan::plausibility::Neighbour> FleetPlatform::neighbours(MavlinkVehicle const& craft) const {
  std::vector<plan::plausibility::Neighbour> others;
  for (auto const* other : fleet_.all()) {
    if (other == &craft) continue;
    plan::plausibility::Neighbour neighbour{.name = other->state.name};
    if (stands_on_ground(*other).value_or(false)) neighbour.stands = other->state.motion.position.value;
    auto const found = pilots_.find(other->id());
    if (found != pilots_.end() && found->second->is_flying())
      neighbour.lands_at = found->second->runs().back()->lands_at;
    others.push_back(std::move(neighbour));
  }
  return others;
}

Pilot& FleetPlatform::pilot(MavlinkVehicle& craft) {
  auto& entry = pilots_[craft.id()];
  if (!entry) entry = std::make_unique<Pilot>(RunContext{craft.connection, craft, options_.run, log_}, settled_);
  return *entry;
}

}  // namespace lapwing::fleet
