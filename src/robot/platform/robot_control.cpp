#include "robot/platform/robot_control.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/wall_clock.hpp"

namespace lapwing::robot {

using base::ErrorKind;
using base::fail;
using vehicle::Action;
using vehicle::Commander;
using vehicle::CommandOutcome;
using vehicle::CommandRecord;
using vehicle::CommandState;
using vehicle::VehicleId;

namespace {

constexpr base::Duration kill_again_after = std::chrono::milliseconds(200);
constexpr base::Duration patience = std::chrono::seconds(5);  ///< of a stop that is not seen

/// The drive that a command is; nothing for those that are none.
std::optional<std::vector<Step>> steps_of(vehicle::VehicleCommand const& command) {
  if (command.action == Action::return_home) return std::vector<Step>{ReturnStep{}};
  if (command.action == Action::go_to) return std::vector<Step>{DriveToPlaceStep{*command.place}};
  return std::nullopt;
}

bool is_known(Action action) {
  switch (action) {
    case Action::hold:
    case Action::return_home:
    case Action::go_to:
    case Action::arm:
    case Action::disarm: return true;
    default: return false;
  }
}

}  // namespace

RobotControl::RobotControl(RobotPlatform& platform, Surroundings around, base::Logger log)
    : platform_(platform), around_(around), log_(log.named("command")), scope_(around.loop) {}

base::Result<std::uint64_t> RobotControl::command(vehicle::VehicleCommand command, std::span<VehicleId const> vehicles,
                                                  Commander by, bool takes_over) {
  if (vehicles.empty()) return fail(ErrorKind::invalid_input, "no vehicle was named to command");
  if (command.action == Action::go_to && !command.place)
    return fail(ErrorKind::invalid_input, "go_to needs a place", "give lat_deg and lon_deg");
  vehicle::make_room(records_);
  auto& record = records_.emplace_back(CommandRecord{
      .number = ++last_number_, .command = std::move(command), .by = std::move(by), .asked = base::wall_now()});
  for (auto const& id : vehicles) {
    bool const is_twice = std::ranges::find(record.outcomes, id, &CommandOutcome::vehicle) != record.outcomes.end();
    if (!is_twice) give(record, id, takes_over);
  }
  ++revision_;
  return record.number;
}

base::Result<> RobotControl::let_through(VehicleId const& id, vehicle::VehicleCommand const& command,
                                         Commander const& by, bool takes_over) {
  auto& authority = around_.authority;
  auto const& robot = *platform_.robot(id);
  bool const stops = vehicle::is_stop(command.action) || command.action == Action::disarm;
  if (!is_known(command.action))
    return fail(ErrorKind::refused, fmt::format("{} is a robot: {} is nothing that it can do", robot.spec().name,
                                                to_string(command.action)));
  if (!robot.is_connected() && !stops)
    return fail(ErrorKind::lost, fmt::format("{} is not heard: nothing that moves it is sent", robot.spec().name));
  if (authority.barred() && command.action != Action::hold && command.action != Action::disarm)
    return fail(ErrorKind::refused, *authority.barred());
  if (authority.barred()) return {};
  auto const& has = robot.state().control.commander;
  if (takes_over || (stops && (has.empty() || has == vehicle::script_commander))) {
    authority.take(id, by);
    return {};
  }
  return stops ? base::Result<>{} : authority.claim(id, by);
}

void RobotControl::give(CommandRecord& record, VehicleId const& id, bool takes_over) {
  record.outcomes.push_back({.vehicle = id});
  auto* const robot = platform_.robot(id);
  if (!robot) return show(record.number, id, CommandState::refused, fmt::format("there is no vehicle {}", id.text));
  if (auto through = let_through(id, record.command, record.by, takes_over); !through)
    return show(record.number, id, CommandState::refused, through.error().message);
  log_.info(fmt::format("{} commands {} to {}", record.by, to_string(record.command.action), robot->spec().name));
  auto const action = record.command.action;
  if (auto steps = steps_of(record.command)) {
    if (robot->needs_restart())
      return show(record.number, id, CommandState::refused, "it is stopped: let it go again first (arm)");
    auto drive = robot->start(fmt::format("{} by {}", to_string(action), record.by), *std::move(steps));
    show(record.number, id, CommandState::under_way);
    return scope_.spawn(follow(record.number, id, std::move(drive)));
  }
  if (action == Action::arm) {
    if (auto const restarted = robot->restart(); !restarted)
      return show(record.number, id, CommandState::refused, restarted.error().message);
    return show(record.number, id, CommandState::confirmed, "it may drive");
  }
  if (action == Action::disarm) {
    robot->kill(fmt::format("stopped by {}", record.by));
  } else {
    robot->end_drive(fmt::format("{} lets it stand", record.by), true);
  }
  show(record.number, id, CommandState::accepted);
  scope_.spawn(wait_until_it_stands(record.number, id));
}

base::Task<> RobotControl::follow(std::uint64_t number, VehicleId id, std::shared_ptr<DriveRecord const> drive) {
  auto& robot = *platform_.robot(id);
  while (drive->outcome == DriveRecord::Outcome::running) co_await robot.changed().wait();
  switch (drive->outcome) {
    case DriveRecord::Outcome::done: show(number, id, CommandState::confirmed, "it is there"); break;
    case DriveRecord::Outcome::stopped: show(number, id, CommandState::superseded, drive->error); break;
    default: show(number, id, CommandState::cut_short, drive->error); break;
  }
}

base::Task<> RobotControl::wait_until_it_stands(std::uint64_t number, VehicleId id) {
  auto& robot = *platform_.robot(id);
  auto const stood = co_await robot.changed().wait_for([&robot] { return robot.stands(); }, patience);
  show(number, id, stood ? CommandState::confirmed : CommandState::timed_out, stood ? "it stands" : "it still moves");
}

void RobotControl::show(std::uint64_t number, VehicleId const& id, CommandState state, std::string reason) {
  auto const record = std::ranges::find(records_, number, &CommandRecord::number);
  if (record == records_.end()) return;
  auto const outcome = std::ranges::find(record->outcomes, id, &CommandOutcome::vehicle);
  if (outcome == record->outcomes.end()) return;
  outcome->state = state;
  outcome->reason = std::move(reason);
  ++revision_;
}

// ---- emergency stop

void RobotControl::emergency_stop(std::optional<vehicle::StopAction> action, Commander by) {
  auto const reason = fmt::format("emergency stop by {}", by);
  around_.authority.bar(reason + ": release it first");
  emergency_ = {.is_latched = true,
                .action = action.value_or(vehicle::StopAction::hold),
                .by = std::move(by),
                .since = base::wall_now()};
  for (auto const& robot : platform_.robots()) {
    emergency_.vehicles.push_back({.vehicle = robot->id()});
    robot->kill(reason);
  }
  ++revision_;
  stopping_ = keep_stopped();
  stopping_.start();
}

base::Task<> RobotControl::keep_stopped() {
  for (;;) {
    for (auto& outcome : emergency_.vehicles) {
      auto* const robot = platform_.robot(outcome.vehicle);
      bool const is_confirmed = robot->is_killed() && robot->stands();
      outcome.is_acknowledged = robot->is_killed();
      if (!robot->is_killed()) {
        robot->kill(fmt::format("emergency stop by {}", emergency_.by));
        ++outcome.tries;
      }
      auto detail = is_confirmed ? "stands" : robot->is_connected() ? "is told to stop" : "is not heard";
      if (outcome.is_confirmed == is_confirmed && outcome.detail == detail) continue;
      outcome.is_confirmed = is_confirmed;
      outcome.detail = detail;
      ++revision_;
    }
    co_await around_.loop.sleep(kill_again_after);
  }
}

void RobotControl::release_emergency_stop(Commander by) {
  if (!std::exchange(emergency_.is_latched, false)) return;
  stopping_ = {};
  around_.authority.bar(std::nullopt);
  for (auto const& robot : platform_.robots())
    if (auto const restarted = robot->restart(); !restarted)
      log_.warn(fmt::format("{} stays stopped: {}", robot->spec().name, restarted.error().message));
  log_.warn(fmt::format("emergency stop of robots released by {}", by));
  ++revision_;
}

// ---- who is in command

base::Result<> RobotControl::request_control(VehicleId const& id, Commander by) {
  return around_.authority.request(id, std::move(by), around_.answer_timeout);
}

base::Result<> RobotControl::yield_control(VehicleId const& id, Commander by) {
  if (around_.authority.yield(id, by)) return {};
  return fail(ErrorKind::refused, fmt::format("vehicle {} is not commanded by {}", id.text, by));
}

base::Result<> RobotControl::keep_control(VehicleId const& id, Commander by) {
  if (around_.authority.keep(id, by)) return {};
  return fail(ErrorKind::refused, fmt::format("vehicle {} is not commanded by {}", id.text, by));
}

void RobotControl::forget(Commander const& by) {
  for (auto const& robot : platform_.robots()) around_.authority.forget(robot->id(), by);
}

}  // namespace lapwing::robot
