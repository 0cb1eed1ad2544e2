#include "fleet/control/fleet_control.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/wall_clock.hpp"
#include "fleet/actions/operator_actions.hpp"
#include "fleet/plausibility/commands.hpp"

namespace lapwing::fleet {

using base::ErrorKind;
using base::fail;
using base::Result;
using vehicle::Action;
using vehicle::Commander;
using vehicle::CommandOutcome;
using vehicle::CommandRecord;
using vehicle::CommandState;
using vehicle::VehicleId;

namespace {

/// What a command lacks, whatever vehicle it is for.
Result<> check(vehicle::VehicleCommand const& command) {
  constexpr double highest_m = 10'000.0;
  auto const height_m = command.height_m.value_or(1.0);
  if (command.action == Action::take_off && !(height_m > 0.0 && height_m <= highest_m))
    return fail(ErrorKind::invalid_input, "the height to take off to must be above 0 and at most 10000 m");
  if (!(height_m >= -highest_m && height_m <= highest_m))
    return fail(ErrorKind::invalid_input, "the height must be a number of metres up to 10000");
  if (command.action == Action::go_to && !command.place)
    return fail(ErrorKind::invalid_input, "go_to needs a place", "give lat_deg and lon_deg");
  if (command.action == Action::set_mode && command.mode.empty())
    return fail(ErrorKind::invalid_input, "set_mode needs a mode", "by the autopilot's own name, as GUIDED");
  return {};
}

bool may_arm(Action action) {
  return action == Action::arm || action == Action::take_off || action == Action::start_mission;
}

CommandState state_after(base::Error const& error, bool was_accepted, bool is_past_expiry) {
  switch (error.kind) {
    case ErrorKind::refused:
    case ErrorKind::invalid_input: return CommandState::refused;
    case ErrorKind::cancelled: return CommandState::superseded;
    default: return is_past_expiry && !was_accepted ? CommandState::expired : CommandState::timed_out;
  }
}

/// What has come too late to be sent, was refused, or has ended otherwise, stays so. What showed no effect may show it
/// yet.
bool is_final(CommandState state) {
  return vehicle::is_over(state) && state != CommandState::timed_out;
}

}  // namespace

FleetControl::FleetControl(Fleet& fleet, FleetPlatform& platform, Options options, base::Logger log)
    : fleet_(fleet),
      platform_(platform),
      options_(std::move(options)),
      log_(log.named("command")),
      emergency_(
          fleet, [this] { ++revision_; }, log.named("emergency")),
      others_(fleet, log.named("others")),
      acknowledgements_(fleet.subscribe(
          [this](Network& network, mavlink::Received const& received) { take_late_arming(network, received); })),
      scope_(fleet.loop()) {
  fleet_.authority().add_on_loss([this](VehicleId const& id, Commander const& to) {
    auto* const craft = fleet_.find(id);
    if (!craft) return;
    auto const reason = fmt::format("{} took {} over", to, craft->state.name);
    if (supersede(id, reason)) emergency_.resume(*craft);
    platform_.yield(id, reason);
  });
}

// ---- commands

Result<std::uint64_t> FleetControl::command(vehicle::VehicleCommand command, std::span<VehicleId const> vehicles,
                                            Commander by, bool takes_over) {
  if (vehicles.empty()) return fail(ErrorKind::invalid_input, "no vehicle was named to command");
  if (auto checked = check(command); !checked) return std::unexpected(checked.error());
  if (auto allowed = settings_for(command, options_.plausibility); !allowed) return std::unexpected(allowed.error());
  vehicle::make_room(records_);
  auto& record = records_.emplace_back(CommandRecord{
      .number = ++last_number_, .command = std::move(command), .by = std::move(by), .asked = base::wall_now()});
  log_.info(fmt::format("{} commands {} to {} vehicle{}", record.by, to_string(record.command.action), vehicles.size(),
                        vehicles.size() == 1 ? "" : "s"));
  for (auto const& id : vehicles) {
    bool const is_twice = std::ranges::find(record.outcomes, id, &CommandOutcome::vehicle) != record.outcomes.end();
    if (!is_twice) give(record, id, takes_over);
  }
  ++revision_;
  return record.number;
}

void FleetControl::give(CommandRecord& record, VehicleId const& id, bool takes_over) {
  record.outcomes.push_back({.vehicle = id});
  auto* const craft = fleet_.find(id);
  if (!craft) return show(record.number, id, CommandState::refused, fmt::format("there is no vehicle {}", id.text));
  bool const was_nobodys = craft->state.control.commander.empty() || craft->runs->loans > 0;
  if (auto through = let_through(*craft, record, takes_over); !through)
    return show(record.number, id, CommandState::refused, through.error().message);
  if (craft->state.control.commander == record.by)
    craft->runs.write(As<FleetControl>()).loans = 0;  // from now on he has it for more than a parameter
  supersede(id, fmt::format("{} by {} came after it", to_string(record.command.action), record.by));
  // A stop is not given up while there is a chance; what makes a vehicle move must not come late.
  auto const patience = is_stop(record.command.action) ? 3 * options_.expiry : options_.expiry;
  auto& running = running_[id];
  running.number = record.number;
  running.made_commander = was_nobodys;
  craft->asked.write(As<FleetControl>()).arming_begun.reset();
  running.task = carry(*craft, record.number, record.command, fleet_.loop().now() + patience);
  running.task.start();
}

/// Whether the giver may command the vehicle; takes it from who has it if he may do that.
Result<> FleetControl::let_through(MavlinkVehicle& craft, CommandRecord const& record, bool takes_over) {
  auto& authority = fleet_.authority();
  bool const stops = is_stop(record.command.action);
  if (!craft.is_connected() && !stops)
    return fail(ErrorKind::lost, fmt::format("{} is not heard: nothing that moves it is sent", craft.state.name));
  if (authority.barred()) {
    if (!stops) return fail(ErrorKind::refused, *authority.barred());
    emergency_.leave_to_operator(craft.id());
    return {};
  }
  auto const& has = craft.state.control.commander;
  if (takes_over || (stops && (has.empty() || has == vehicle::script_commander))) {
    authority.take(craft.id(), record.by);
    return {};
  }
  return stops ? Result<>{} : authority.claim(craft.id(), record.by);
}

base::Task<> FleetControl::carry(MavlinkVehicle& craft, std::uint64_t number, vehicle::VehicleCommand command,
                                 base::TimePoint expires) {
  auto const id = craft.id();
  Goal goal(craft, command, fleet_.loop().now());
  std::function<void()> const on_accepted = [this, number, id, &goal] {
    goal.acknowledge(fleet_.loop().now());
    show(number, id, CommandState::accepted, "");
  };
  ActionOptions const how{.not_after = expires, .is_urgent = is_stop(command.action), .on_accepted = on_accepted};
  Doubts doubts;
  auto ended = co_await heed_command(craft, command, *settings_for(command, options_.plausibility),
                                     platform_.neighbours(), doubts, log_);
  if (ended) ended = co_await carry_out(craft.connection, craft, command, how);
  if (!ended) emergency_.resume(craft);
  if (!ended) fail_command(craft, number, ended.error(), expires);
  auto const rule = doubts.refused_by();
  if (auto* const shown = outcome_of(number, id); rule && shown && shown->state == CommandState::refused)
    shown->rule = to_string(*rule);
  running_[id].is_sent = true;
  // An arming that comes late is taken back.
  if (!ended && may_arm(command.action) && (command.action == Action::arm || craft.asked->may_arm_late_until))
    co_return;
  auto const* const outcome = outcome_of(number, id);
  if (outcome && !is_final(outcome->state)) co_await watch(craft, number, goal);
}

base::Task<> FleetControl::watch(MavlinkVehicle& craft, std::uint64_t number, Goal& goal) {
  using Kind = Standing::Kind;
  constexpr base::Duration look_at_least = std::chrono::seconds(1);
  constexpr base::Duration late = std::chrono::minutes(10);
  constexpr base::Duration is_silent = std::chrono::seconds(3);
  auto& loop = fleet_.loop();
  auto const begun = loop.now();
  auto told = begun - look_at_least;
  std::optional<base::TimePoint> heard;  // first, since then
  for (;;) {
    auto const now = loop.now();
    auto const* const outcome = outcome_of(number, craft.id());
    if (!outcome) co_return;
    auto const state = outcome->state;
    if (!heard && craft.state.links.heartbeat_heard >= begun) heard = now;
    auto const standing = goal.look(craft, now);
    auto const silent = now - craft.state.links.heartbeat_heard;
    auto const age = silent < is_silent ? "" : fmt::format("; not heard for {:.0f} s", base::to_seconds(silent));
    switch (standing.kind) {
      case Kind::unseen:
        if (state != CommandState::timed_out && now - begun >= goal.patience())
          show(number, craft.id(), CommandState::timed_out, fmt::format("accepted, but {}{}", standing.text, age));
        break;
      case Kind::under_way:
        running_[craft.id()].stands = standing.text;
        if (state == CommandState::under_way && now - told < look_at_least) break;
        told = now;
        show(number, craft.id(), CommandState::under_way, standing.text + age, standing.left_m);
        break;
      case Kind::reached: show(number, craft.id(), CommandState::confirmed, standing.text); co_return;
      case Kind::cut_short: show(number, craft.id(), CommandState::cut_short, standing.text); co_return;
    }
    bool const has_had_time = heard && now - *heard > 3 * goal.patience();
    bool const is_hopeless = standing.kind == Kind::unseen && (has_had_time || now - begun > late);
    if (state == CommandState::timed_out && is_hopeless) co_return;
    co_await craft.changed.wait_until(now + look_at_least);
  }
}

void FleetControl::fail_command(MavlinkVehicle& craft, std::uint64_t number, base::Error const& error,
                                base::TimePoint expires) {
  auto const* const outcome = outcome_of(number, craft.id());
  if (!outcome) return;
  auto const record = std::ranges::find(records_, number, &CommandRecord::number);
  bool const was_accepted = outcome->state == CommandState::accepted;
  if (may_arm(record->command.action) && error.kind != ErrorKind::refused) expect_late_arming(craft);
  // Who asked for what the vehicle cannot do has not commanded it.
  if (error.kind == ErrorKind::invalid_input && running_[craft.id()].made_commander)
    (void)fleet_.authority().yield(craft.id(), record->by);
  show(number, craft.id(), state_after(error, was_accepted, fleet_.loop().now() >= expires), error.message);
}

bool FleetControl::supersede(VehicleId const& id, std::string const& reason) {
  auto const found = running_.find(id);
  if (found == running_.end()) return false;
  auto const number = found->second.number;
  bool const was_being_sent = !found->second.task.done() && !found->second.is_sent;
  auto const stands = std::move(found->second.stands);
  running_.erase(found);  // from here on nothing of it is sent
  auto const* const outcome = outcome_of(number, id);
  if (!outcome) return was_being_sent;
  auto const state = outcome->state;
  if (vehicle::is_over(state)) return false;
  auto const record = std::ranges::find(records_, number, &CommandRecord::number);
  if (was_being_sent && may_arm(record->command.action)) expect_late_arming(*fleet_.find(id));
  if (state == CommandState::under_way) {
    show(number, id, CommandState::cut_short, fmt::format("{}, {}", reason, stands));
  } else {
    show(number, id, CommandState::superseded, reason);
  }
  return was_being_sent;
}

CommandOutcome* FleetControl::outcome_of(std::uint64_t number, VehicleId const& id) {
  auto const record = std::ranges::find(records_, number, &CommandRecord::number);
  if (record == records_.end()) return nullptr;
  auto const outcome = std::ranges::find(record->outcomes, id, &CommandOutcome::vehicle);
  return outcome == record->outcomes.end() ? nullptr : &*outcome;
}

void FleetControl::show(std::uint64_t number, VehicleId const& id, CommandState state, std::string reason,
                        std::optional<double> left_m) {
  auto* const outcome = outcome_of(number, id);
  if (!outcome || is_final(outcome->state)) return;
  if (outcome->state == state && outcome->reason == reason && outcome->left_m == left_m) return;
  bool const is_late = outcome->state == CommandState::timed_out;
  *outcome = {.vehicle = id, .state = state, .reason = std::move(reason), .left_m = left_m};
  ++revision_;
  if (!vehicle::is_over(state)) return;
  auto const record = std::ranges::find(records_, number, &CommandRecord::number);
  auto const line =
      fmt::format("{} of vehicle {}: {}{}{}{}", to_string(record->command.action), id.text, to_string(state),
                  is_late ? " after all" : "", outcome->reason.empty() ? "" : ": ", outcome->reason);
  state == CommandState::confirmed ? log_.info(line) : log_.warn(line);
}

/// The arming of a command that has ended may still be on its way, if it was sent at all.
void FleetControl::expect_late_arming(MavlinkVehicle& craft) {
  constexpr base::Duration links_keep = std::chrono::seconds(60);
  auto& commands = craft.connection.commands();
  auto const sent = commands.last_sent(craft.address.system, mavlink::MavCmd::component_arm_disarm);
  if (craft.heard->is_armed || !craft.asked->arming_begun || !sent || *sent < *craft.asked->arming_begun) return;
  craft.asked.write(As<FleetControl>()).may_arm_late_until = fleet_.loop().now() + links_keep;
}

/// An acknowledgement to us of an arming that we have given up: the link had kept one or the other.
void FleetControl::take_late_arming(Network& network, mavlink::Received const& received) {
  auto const* ack = std::get_if<mavlink::CommandAck>(&received.message);
  if (!ack || ack->command != mavlink::MavCmd::component_arm_disarm || ack->result != mavlink::MavResult::accepted)
    return;
  if (!mavlink::addresses(ack->target, network.connection().self())) return;
  auto* const craft = network.find(received.source.system);
  if (!craft || !craft->asked->may_arm_late_until || received.at > *craft->asked->may_arm_late_until) return;
  // A station that rides along may have our id.
  if (network.connection().commands().was_just_passed_on(received.source.system, ack->command, received.at)) return;
  scope_.spawn(take_back(*craft));
}

/// The acknowledgement does not tell an arming from a disarming; the next heartbeat does.
base::Task<> FleetControl::take_back(MavlinkVehicle& craft) {
  constexpr base::Duration heartbeats = std::chrono::seconds(3);
  auto const armings = craft.asked->armings;
  std::function<bool()> is_armed = [&craft] { return craft.heard->is_armed; };
  if (!co_await craft.changed.wait_for(std::move(is_armed), heartbeats)) co_return;
  if (craft.asked->armings != armings) co_return;  // somebody here wants it armed meanwhile
  if (!std::exchange(craft.asked.write(As<FleetControl>()).may_arm_late_until, std::nullopt)) co_return;
  log_.error(fmt::format("{} has carried out an arming that came too late: it is disarmed again", craft.state.name));
  ActionOptions const how{.is_urgent = true};
  auto const disarmed = co_await disarm(craft.connection, craft, how);
  if (!disarmed) log_.error(fmt::format("{} stays armed: {}", craft.state.name, disarmed.error().message));
}

// ---- emergency stop

void FleetControl::emergency_stop(std::optional<vehicle::StopAction> action, Commander by) {
  auto const reason = fmt::format("emergency stop by {}", by);
  fleet_.authority().bar(reason + ": release it first");
  while (!running_.empty()) {
    auto const id = running_.begin()->first;
    supersede(id, reason);
  }
  platform_.yield_all(reason);
  // Pressed once more it must not make less of a stop that was made stronger.
  auto const& latched = emergency_.state();
  emergency_.latch(action.value_or(latched.is_latched ? latched.action : options_.stop_action), std::move(by));
  if (on_latched_) on_latched_(reason);
}

void FleetControl::release_emergency_stop(Commander by) {
  fleet_.authority().bar(std::nullopt);
  emergency_.release(by);
}

// ---- who is in command

Result<> FleetControl::request_control(VehicleId const& id, Commander by) {
  return fleet_.authority().request(id, std::move(by), options_.answer_timeout);
}

Result<> FleetControl::yield_control(VehicleId const& id, Commander by) {
  if (fleet_.authority().yield(id, by)) return {};
  return fail(ErrorKind::refused, fmt::format("vehicle {} is not commanded by {}", id.text, by));
}

Result<> FleetControl::keep_control(VehicleId const& id, Commander by) {
  if (fleet_.authority().keep(id, by)) return {};
  return fail(ErrorKind::refused, fmt::format("vehicle {} is not commanded by {}", id.text, by));
}

void FleetControl::forget(Commander const& by) {
  for (auto* craft : fleet_.all()) fleet_.authority().forget(craft->id(), by);
}

}  // namespace lapwing::fleet
