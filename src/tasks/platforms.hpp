#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "tasks/platform.hpp"

namespace lapwing::tasks {

/// Several platforms as one: what a script runs on where there are drones and robots. Words, plans and vehicles of all;
/// what concerns one vehicle goes to the platform that has it. With one platform it is that platform.
///
/// A vehicle whose id another platform's vehicle has as well is nobody's: it counts as not connected, and nothing is
/// started on it or told it, until one of the two is gone. Thread-bound.
class Platforms final : public Platform {
 public:
  /// The loop outlives this.
  Platforms(base::Loop& loop, base::Logger log) : log_(std::move(log)), changed_(loop), scope_(loop) {}
  Platforms(Platforms const&) = delete;
  Platforms& operator=(Platforms const&) = delete;

  /// One more, before anything else is asked; it outlives this. `name` is what messages call it. Errors: invalid_input
  /// when it gives a word or a plan of another one a second meaning.
  [[nodiscard]] base::Result<> add(std::string name, Platform& platform);

  [[nodiscard]] Vocabulary const& vocabulary() const override { return vocabulary_; }
  /// Of the first that knows the name.
  [[nodiscard]] base::Result<std::shared_ptr<PlatformTask const>> named_task(std::string_view name) const override;
  [[nodiscard]] std::vector<std::string> plan_names() const override;

  /// Those of the platform that was added first come first.
  [[nodiscard]] std::vector<VehicleInfo> vehicles() const override;
  [[nodiscard]] std::optional<VehicleInfo> find(VehicleId const& id) const override;
  [[nodiscard]] base::Notifier& vehicles_changed() override;
  [[nodiscard]] base::TimePoint all_heard_by() const override;
  void set_connection_timeout(VehicleId const& id, base::Duration timeout) override;

  [[nodiscard]] base::Result<> perform(InstructionCall const& call, VehicleId const& id) override;
  [[nodiscard]] std::optional<std::string> unsuited(PlatformTask const& task,
                                                    VehicleInfo const& vehicle) const override;
  [[nodiscard]] std::unique_ptr<TaskRun> start(std::shared_ptr<PlatformTask const> task, VehicleId const& id) override;
  [[nodiscard]] base::Task<void> settle() override;

 private:
  struct Member {
    std::string name;
    Platform* platform;
  };
  /// Which have a vehicle of that id: one unless there is none, or a conflict.
  [[nodiscard]] std::vector<Member const*> owners(VehicleId const& id) const;
  /// The one that has it. Errors: lost when there is none, refused when there are several.
  [[nodiscard]] base::Result<Platform*> owner(VehicleId const& id) const;
  base::Task<> pass_on(Platform& from);
  void look_for_conflicts();

  base::Logger log_;
  std::vector<Member> members_;
  Vocabulary vocabulary_;
  base::Notifier changed_;
  std::set<VehicleId> in_conflict_;  ///< those that have been told
  base::Scope scope_;
};

}  // namespace lapwing::tasks
