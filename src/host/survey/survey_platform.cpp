#include "host/survey/survey_platform.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "autonomy/words/vocabulary.hpp"
#include "host/survey/survey_stop.hpp"
#include "tasks/failed_run.hpp"

namespace lapwing::host {

using namespace std::chrono_literals;
using base::ErrorKind;
using tasks::RunState;
using tasks::VehicleInfo;
using vehicle::VehicleId;

namespace {

constexpr base::Duration usual_connection_timeout = 20s;
constexpr base::Duration say_again_every = 1s;
constexpr base::Duration longest_hold = 10s;

}  // namespace

struct SurveyPlatform::Pilot {
  explicit Pilot(std::string name) : drone(std::move(name)) {}

  std::string drone;
  base::Duration connection_timeout = usual_connection_timeout;
  std::unique_ptr<LotFlight> flight = {};  ///< the last one
  base::Task<> flying = {};
  bool is_holding = false;
  base::Task<> holding = {};

  [[nodiscard]] bool flies() const { return flight && flight->record()->outcome == LotRecord::Outcome::running; }
};

/// A lot as scripts see it.
class SurveyPlatform::LotRun final : public tasks::TaskRun {
 public:
  LotRun(SurveyPlatform& platform, Pilot& pilot)
      : platform_(platform), pilot_(pilot), record_(pilot.flight->record()) {}

  [[nodiscard]] RunState state() const override {
    switch (record_->outcome) {
      case LotRecord::Outcome::running: return RunState::in_progress;
      case LotRecord::Outcome::done: return RunState::done;
      case LotRecord::Outcome::failed: return RunState::failed;
    }
    return RunState::failed;
  }
  [[nodiscard]] std::string error() const override { return record_->error; }
  [[nodiscard]] bool vehicle_failed() const override { return record_->is_drone_at_fault; }
  [[nodiscard]] std::string progress() const override {
    auto const survey = platform_.desk_->survey(pilot_.drone);
    if (!survey) return record_->progress;
    return fmt::format("{}, {:.0f} % seen", record_->progress, 100.0 * survey->coverage);
  }
  void stop() override {
    // A later flight of the same drone is not this run's to stop.
    if (record_->outcome == LotRecord::Outcome::running) platform_.stop(pilot_, "the script has stopped it");
  }

 private:
  SurveyPlatform& platform_;
  Pilot& pilot_;
  std::shared_ptr<LotRecord const> record_;
};

SurveyPlatform::SurveyPlatform(base::Loop& loop, base::Logger log)
    : loop_(loop), log_(std::move(log)), vocabulary_(autonomy::vocabulary()), never_(loop), settled_(loop) {}

SurveyPlatform::~SurveyPlatform() = default;

void SurveyPlatform::open(std::unique_ptr<SurveyDesk> desk) {
  desk_ = std::move(desk);
  for (auto const& drone : desk_->drones()) pilots_.push_back(std::make_unique<Pilot>(drone.name));
  desk_->set_on_operator([this](std::string_view drone) {
    auto* const pilot = pilot_of({std::string(drone)});
    if (!pilot->flies()) return;
    pilot->flying = {};
    auto& record = *pilot->flight->record();
    record.error = fmt::format("an operator took {} over", drone);
    record.is_drone_at_fault = true;
    record.outcome = LotRecord::Outcome::failed;
  });
}

SurveyPlatform::Pilot* SurveyPlatform::pilot_of(VehicleId const& id) const {
  auto const found = std::ranges::find(pilots_, id.text, [](auto const& pilot) { return pilot->drone; });
  return found == pilots_.end() ? nullptr : found->get();
}

base::Result<std::shared_ptr<tasks::PlatformTask const>> SurveyPlatform::named_task(std::string_view name) const {
  return base::fail(ErrorKind::not_found, fmt::format("there is no plan called '{}'", name));
}

VehicleInfo SurveyPlatform::info_of(vehicle::SurveyDroneView const& drone) const {
  VehicleInfo info;
  info.id = {drone.name};
  info.type = "UAV";
  info.payload = {"Camera"};
  info.connected = drone.is_connected;
  info.position = drone.position;
  info.battery = drone.battery;
  info.connection_timeout = pilot_of(info.id)->connection_timeout;
  info.mode = drone.mode;
  info.relative_alt_m = drone.height_m;
  info.coverage = drone.coverage;
  info.slots = drone.slots;
  return info;
}

std::vector<VehicleInfo> SurveyPlatform::vehicles() const {
  std::vector<VehicleInfo> infos;
  if (!desk_) return infos;
  for (auto const& drone : desk_->drones())
    if (!drone.state.empty()) infos.push_back(info_of(drone));
  return infos;
}

std::optional<VehicleInfo> SurveyPlatform::find(VehicleId const& id) const {
  auto infos = vehicles();
  auto const found = std::ranges::find(infos, id, &VehicleInfo::id);
  return found == infos.end() ? std::nullopt : std::optional(*found);
}

void SurveyPlatform::set_connection_timeout(VehicleId const& id, base::Duration timeout) {
  if (auto* const pilot = pilot_of(id)) pilot->connection_timeout = timeout;
}

std::optional<std::string> SurveyPlatform::unsuited(tasks::PlatformTask const& task, VehicleInfo const& vehicle) const {
  if (!dynamic_cast<autonomy::LotTask const*>(&task))
    return fmt::format("{} is no lot, and a survey drone flies no other tasks", task.name());
  return task.unsuited(vehicle);
}

std::unique_ptr<tasks::TaskRun> SurveyPlatform::start(std::shared_ptr<tasks::PlatformTask const> task,
                                                      VehicleId const& id) {
  auto* const pilot = pilot_of(id);
  if (!pilot) return std::make_unique<tasks::FailedRun>(fmt::format("no survey drone {}", id.text));
  auto const lot = std::dynamic_pointer_cast<autonomy::LotTask const>(task);
  if (!lot)
    return std::make_unique<tasks::FailedRun>(fmt::format("'{}' is no lot: {} cannot do it", task->name(), id.text));
  if (!desk_->is_connected(id.text))
    return std::make_unique<tasks::FailedRun>(fmt::format("{} is lost", id.text), true);
  pilot->holding = {};
  pilot->is_holding = false;
  pilot->flying = {};
  pilot->flight = std::make_unique<LotFlight>(loop_, *desk_, id.text, lot, pilot->connection_timeout);
  pilot->flying = pilot->flight->fly();
  pilot->flying.start();
  settled_.notify_all();
  return std::make_unique<LotRun>(*this, *pilot);
}

void SurveyPlatform::stop(Pilot& pilot, std::string const& reason) {
  pilot.flying = {};
  auto& record = *pilot.flight->record();
  record.error = reason;
  record.outcome = LotRecord::Outcome::failed;
  pilot.is_holding = true;
  pilot.holding = hold(pilot);
  pilot.holding.start();
}

base::Task<> SurveyPlatform::hold(Pilot& pilot) {
  auto const deadline = loop_.now() + longest_hold;
  co_await loop_.sleep(base::Duration::zero());
  for (auto say_at = loop_.now(); desk_->barred().empty();) {  // an emergency stop says itself what is to be done
    auto const stop = survey_stop(vehicle::StopAction::hold, desk_->heartbeat(pilot.drone));
    if (stop.is_done) break;
    if (loop_.now() >= deadline) {
      log_.warn(fmt::format("{} has not shown that it stays where it is", pilot.drone));
      break;
    }
    if (stop.command && loop_.now() >= say_at) {
      if (auto const said = desk_->stop(pilot.drone, *stop.command); !said)
        log_.warn(fmt::format("{} is not told to stay where it is: {}", pilot.drone, said.error().message));
      say_at = loop_.now() + say_again_every;
    }
    co_await desk_->heard().wait_until(std::min(deadline, say_at));
  }
  pilot.is_holding = false;
  settled_.notify_all();
}

base::Task<void> SurveyPlatform::settle() {
  while (std::ranges::any_of(pilots_, &Pilot::is_holding, [](auto const& pilot) -> Pilot& { return *pilot; }))
    co_await settled_.wait();
}

}  // namespace lapwing::host
