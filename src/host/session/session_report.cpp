// What a session tells of a run when it is over.
#include "host/robots/robots.hpp"
#include "host/session/session.hpp"

namespace lapwing::host {

namespace {

CarParkReport car_park_report(LotWatch const& watch, std::optional<LotScore> const& score) {
  using ::lapwing::map::SlotState;
  CarParkReport report{.pictures = watch.pictures(), .coverage = watch.coverage(), .score = score};
  for (auto const& slot : watch.on_the_map())
    ++(slot.state == SlotState::free ? report.free : slot.state == SlotState::taken ? report.taken : report.unknown);
  return report;
}

/// Nothing for what is no robot.
std::optional<RobotReport> robot_report(robot::RobotPlatform const& robots, vehicle::VehicleId const& id) {
  auto const* const robot = robots.robot(id);
  if (!robot) return std::nullopt;
  RobotReport report;
  if (auto const& survey = robot->survey()) {
    report.coverage = survey->coverage;
    report.free_m2 = survey->free_m2;
  }
  report.closures = robot->loops().closures;
  if (auto const* const tags = robots.tags_of(id)) report.signs = tags->texts();
  for (auto const& drive : robot->drives())
    report.drives.push_back({drive->name, std::string(to_string(drive->outcome)), drive->error, drive->remark});
  return report;
}

}  // namespace

RunReport Session::report() const {
  RunReport report;
  auto const status = host.status();
  report.script = status.name;
  report.outcome = host.outcome() ? outcome_word(*host.outcome()) : "running";
  report.started = host.started();
  report.ended = host.finished();
  for (auto const* vehicle : ground.registry.all()) {
    report.vehicles.push_back({.id = vehicle->id.text,
                               .system_id = vehicle->system_id,
                               .type = std::string(to_string(vehicle->family)),
                               .track_m = vehicle->motion.track_m,
                               .pictures = vehicle->payload.pictures.value ? vehicle->payload.pictures.value->taken : 0,
                               .missions = platform.missions(vehicle->id),
                               .robot = robot_report(robots, vehicle->id)});
    auto& told = report.vehicles.back();
    if (told.robot) told.robot->collisions = collisions_of(buildings, told.id);
  }
  if (lot_watch) report.car_park = car_park_report(*lot_watch, lot_score_);
  report.tasks = host.task_trees();
  if (auto const& outcome = host.outcome(); outcome && outcome->kind != dolphin::Outcome::Kind::done) {
    report.errors.push_back({outcome->file, outcome->line, outcome->message});
  }
  return report;
}

}  // namespace lapwing::host
