#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/notifier.hpp"
#include "base/log.hpp"
#include "host/survey/lot_flight.hpp"
#include "host/survey/survey_desk.hpp"
#include "tasks/platform.hpp"

namespace lapwing::host {

/// Survey drones as a platform of the mission language: `lot { ... }` blocks. An operator's command takes a drone from
/// the script. What a script leaves in the air without an operator comes home by itself.
///
/// Thread-bound; outlives the runs that it started.
class SurveyPlatform final : public tasks::Platform {
 public:
  /// `loop` outlives the platform.
  SurveyPlatform(base::Loop& loop, base::Logger log);
  SurveyPlatform(SurveyPlatform const&) = delete;
  SurveyPlatform& operator=(SurveyPlatform const&) = delete;
  ~SurveyPlatform() override;

  /// The drones that there are; once, and before scripts begin.
  void open(std::unique_ptr<SurveyDesk> desk);
  /// Null where there are none.
  [[nodiscard]] SurveyDesk* desk() const { return desk_.get(); }

  [[nodiscard]] tasks::Vocabulary const& vocabulary() const override { return vocabulary_; }
  /// It has no plans: error not_found.
  [[nodiscard]] base::Result<std::shared_ptr<tasks::PlatformTask const>> named_task(
      std::string_view name) const override;
  /// Those that have said something.
  [[nodiscard]] std::vector<tasks::VehicleInfo> vehicles() const override;
  [[nodiscard]] std::optional<tasks::VehicleInfo> find(vehicle::VehicleId const& id) const override;
  [[nodiscard]] base::Notifier& vehicles_changed() override { return desk_ ? desk_->heard() : never_; }
  void set_connection_timeout(vehicle::VehicleId const& id, base::Duration timeout) override;
  /// Lots are what it flies.
  [[nodiscard]] std::optional<std::string> unsuited(tasks::PlatformTask const& task,
                                                    tasks::VehicleInfo const& vehicle) const override;
  [[nodiscard]] std::unique_ptr<tasks::TaskRun> start(std::shared_ptr<tasks::PlatformTask const> task,
                                                      vehicle::VehicleId const& id) override;
  [[nodiscard]] base::Task<void> settle() override;

 private:
  struct Pilot;
  class LotRun;

  [[nodiscard]] Pilot* pilot_of(vehicle::VehicleId const& id) const;
  [[nodiscard]] tasks::VehicleInfo info_of(vehicle::SurveyDroneView const& drone) const;
  /// The drone stays where it is, unless something else is begun with it in the same turn.
  void stop(Pilot& pilot, std::string const& reason);
  [[nodiscard]] base::Task<> hold(Pilot& pilot);

  base::Loop& loop_;
  base::Logger log_;
  tasks::Vocabulary vocabulary_;
  base::Notifier never_;
  base::Notifier settled_;
  std::unique_ptr<SurveyDesk> desk_;
  std::vector<std::unique_ptr<Pilot>> pilots_;  ///< one a drone, in the desk's order
};

}  // namespace lapwing::host
