#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/notifier.hpp"
#include "tasks/platform.hpp"

namespace lapwing::tasks {

/// The test platform of the language's conformance cases: four vehicles that exist only here and tasks that only take
/// time.
///
/// | id | type | payload | at |
/// |---|---|---|---|
/// | a1 | UAV | Camera, Sidescan | 41 N, 8 W |
/// | a2 | UAV | Camera | 41.01 N, 8 W |
/// | u1 | UUV | Sidescan, Multibeam | 41 N, 8 W |
/// | u2 | UUV | | 42 N, 8 W |
///
/// The named task `X:d` is done after d seconds, `fail:d` fails with "boom" after d seconds. Any number of tasks may
/// run on one vehicle; keeping them apart is what allocation is tested for. Tasks of other kinds come by deriving from
/// it.
class HarnessPlatform : public Platform {
 public:
  explicit HarnessPlatform(base::Loop& loop, Vocabulary vocabulary = {});

  [[nodiscard]] Vocabulary const& vocabulary() const override { return vocabulary_; }
  [[nodiscard]] base::Result<std::shared_ptr<PlatformTask const>> named_task(std::string_view name) const override;
  [[nodiscard]] std::vector<VehicleInfo> vehicles() const override { return vehicles_; }
  [[nodiscard]] std::optional<VehicleInfo> find(VehicleId const& id) const override;
  [[nodiscard]] base::Notifier& vehicles_changed() override { return changed_; }
  void set_connection_timeout(VehicleId const& id, base::Duration timeout) override;
  [[nodiscard]] std::optional<std::string> unsuited(PlatformTask const& task,
                                                    VehicleInfo const& vehicle) const override;
  [[nodiscard]] std::unique_ptr<TaskRun> start(std::shared_ptr<PlatformTask const> task, VehicleId const& id) override;
  [[nodiscard]] base::Task<void> settle() override;

  /// Replaces the vehicle of the same id, or adds it: what happens to vehicles while a script runs.
  void set_vehicle(VehicleInfo vehicle);

 protected:
  /// How long the task takes on the vehicle; nothing: until it is stopped. Error: why it cannot run there.
  [[nodiscard]] virtual base::Result<std::optional<base::Duration>> length_of(PlatformTask const& task,
                                                                              VehicleInfo const& vehicle) const;

 private:
  base::Loop& loop_;
  base::Notifier changed_;
  std::vector<VehicleInfo> vehicles_;
  Vocabulary vocabulary_;
};

}  // namespace lapwing::tasks
