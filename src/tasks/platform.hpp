#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/notifier.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "base/time.hpp"
#include "geo/position.hpp"
#include "tasks/vocabulary.hpp"
#include "vehicle/slot_counts.hpp"
#include "vehicle/vehicle_id.hpp"

/// The seam between the mission language and whatever can carry out tasks. The language knows this header and never a
/// protocol; a platform (MAVLink fleet, indoor robot, test harness) implements it and never sees the language. `apps`
/// joins the two.
namespace lapwing::tasks {

using vehicle::VehicleId;

// ---- tasks that run on one vehicle

/// A vehicle as the language sees it.
struct VehicleInfo {
  VehicleId id;
  std::string type;                  ///< "UAV", "UGV", "USV", "UUV"
  std::vector<std::string> payload;  ///< exact names
  bool connected = true;             ///< heard within its connection timeout, and its id is unambiguous
  std::optional<geo::Wgs84> position;
  std::optional<double> battery;  ///< 0..1; nothing while unknown
  base::Duration connection_timeout{};
  bool battery_is_awaited = false;  ///< it has not reported on its battery yet, not even that it does not know
  std::string mode = {};            ///< the flight mode by the autopilot's own name; empty while unknown
  std::optional<double> relative_alt_m = {};      ///< above its home; nothing while unknown
  std::optional<double> coverage = {};            ///< 0..1: what it has seen of what it maps; nothing while unknown
  std::optional<vehicle::SlotCounts> slots = {};  ///< of a survey drone that has found some
  std::size_t doors = 0;                          ///< that a robot has found by their signs
  std::string conflict = {};  ///< which platforms each have a vehicle of this id; empty: it is one vehicle's alone
};

/// An immutable description of something one vehicle can do. Values of the language: shared, reused, never changed.
class PlatformTask {
 public:
  virtual ~PlatformTask() = default;
  [[nodiscard]] virtual std::string name() const = 0;
  /// What views call it: "mission".
  [[nodiscard]] virtual std::string kind() const { return "task"; }
  /// It goes on until it is stopped: nothing that stands behind it in a sequence is ever reached.
  [[nodiscard]] virtual bool never_ends() const { return false; }
  /// Why the vehicle cannot do it ("no payload Camera"), or nothing.
  [[nodiscard]] virtual std::optional<std::string> unsuited(VehicleInfo const& vehicle) const = 0;
  /// Roughly, for the limit on what a script may hold.
  [[nodiscard]] virtual std::size_t bytes() const { return 256; }
  /// Where it begins, so that allocation can prefer the nearest vehicle; nothing: the first suitable one.
  [[nodiscard]] virtual std::optional<geo::Wgs84> reference_position() const = 0;
  /// Why no vehicle can carry it out that has just done `before`.
  [[nodiscard]] virtual std::optional<Doubt> cannot_follow(PlatformTask const& before) const {
    (void)before;
    return std::nullopt;
  }
};

/// `command: 400` in the call of an instruction.
struct NamedValue {
  std::string name;
  Argument value;
};

/// A `VehicleInstruction` as a script gives it, without the vehicles: arguments complete and of the declared types,
/// values in the order in which they were written.
struct InstructionCall {
  std::string_view name;
  std::span<Argument const> arguments = {};
  std::span<NamedValue const> values = {};
};

enum class RunState { in_progress, done, failed };

/// One platform task on its way on one vehicle. Polled once a tick; destroyed after it ended or was stopped.
class TaskRun {
 public:
  virtual ~TaskRun() = default;
  [[nodiscard]] virtual RunState state() const = 0;
  /// Why, when failed.
  [[nodiscard]] virtual std::string error() const = 0;
  /// When failed: it was the vehicle or the way to it (lost, restarted, not to be told apart), not the task.
  [[nodiscard]] virtual bool vehicle_failed() const { return false; }
  /// Short text for people: "uploading 4/12", "item 3/12".
  [[nodiscard]] virtual std::string progress() const = 0;
  /// Ends it early. Returns at once; the platform goes on putting the vehicle into its stop state unless another task
  /// starts on the same vehicle in the same turn, and `Platform::settle` waits for that.
  virtual void stop() = 0;
};

class Platform {
 public:
  virtual ~Platform() = default;

  /// What it adds to the language; the same for the whole life of the platform.
  [[nodiscard]] virtual Vocabulary const& vocabulary() const = 0;
  /// The plan called `name` made elsewhere: `task('survey1')`.
  [[nodiscard]] virtual base::Result<std::shared_ptr<PlatformTask const>> named_task(std::string_view name) const = 0;
  /// The names that `named_task` knows, as far as they can be listed: for "did you mean".
  [[nodiscard]] virtual std::vector<std::string> plan_names() const { return {}; }

  /// All known vehicles, lost ones included, in the order in which `pick` prefers them.
  [[nodiscard]] virtual std::vector<VehicleInfo> vehicles() const = 0;
  [[nodiscard]] virtual std::optional<VehicleInfo> find(VehicleId const& id) const = 0;
  /// Notified when a vehicle appears, is lost or returns, so that `pick` need not poll.
  [[nodiscard]] virtual base::Notifier& vehicles_changed() = 0;
  /// Until then a vehicle that is there may not have been heard yet: `pick` does not give up earlier, whatever its
  /// timeout.
  [[nodiscard]] virtual base::TimePoint all_heard_by() const { return {}; }
  virtual void set_connection_timeout(VehicleId const& id, base::Duration timeout) = 0;

  /// Carries out an instruction of its vocabulary. Returns without waiting for any answer. Errors: refused for one that
  /// these vehicles do not know; not_found or invalid_input for what the instruction does not take; the kinds of a
  /// link's errors.
  [[nodiscard]] virtual base::Result<> perform(InstructionCall const& call, VehicleId const& id);

  /// Why `vehicle`, one of this platform's, cannot carry out the task, or nothing: what the task says of itself, and
  /// that it is a kind of task which the platform does not know.
  [[nodiscard]] virtual std::optional<std::string> unsuited(PlatformTask const& task,
                                                            VehicleInfo const& vehicle) const {
    return task.unsuited(vehicle);
  }
  /// Starts `task` on the vehicle. Never blocks; every failure shows in the run.
  [[nodiscard]] virtual std::unique_ptr<TaskRun> start(std::shared_ptr<PlatformTask const> task,
                                                       VehicleId const& id) = 0;
  /// Ends when every stop that was asked for has been confirmed by its vehicle, or has failed with a logged reason.
  [[nodiscard]] virtual base::Task<void> settle() = 0;
};

}  // namespace lapwing::tasks
