#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/async/notifier.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "base/time.hpp"
#include "geo/position.hpp"
#include "vehicle/vehicle_id.hpp"

/// The seam between the mission language and whatever can carry out tasks. The language knows this header and never a
/// protocol; a platform (MAVLink fleet, indoor robot, test harness) implements it and never sees the language. `apps`
/// joins the two.
namespace lapwing::tasks {

using vehicle::VehicleId;

// ---- what a platform adds to the language

/// A script value as a builder command receives it. Units are already SI (angles that users write in degrees stay
/// degrees only where the parameter says so); a vehicle set never reaches a builder.
using Argument = std::variant<std::monostate, bool, std::int64_t, double, std::string, geo::Wgs84, geo::Ned>;

enum class Type { number, integer, text, boolean, position, displacement };
/// What a number means, for the checker: `timeout 2.km` is wrong before anything flies.
enum class Dimension { none, length, angle, time, speed, ratio };

struct Parameter {
  std::string_view name;
  Type type = Type::number;
  Dimension dimension = Dimension::none;
  std::optional<Argument> fallback = std::nullopt;  ///< present: the argument may be left out (trailing ones only)
  std::string_view doc = {};
  std::vector<std::string_view> choices = {};  ///< text parameters with a fixed set of values
};

struct Overload {
  std::vector<Parameter> parameters;
};

/// One word that may stand inside a builder's block: `takeOff pos, 15`.
struct CommandSpec {
  std::string_view name;
  std::vector<Overload> overloads;
  std::string_view doc;
  /// The types of vehicle ("UAV") that can carry it out; empty: every type.
  std::vector<std::string_view> vehicle_types = {};

  /// False when no vehicle of that type can carry it out: `takeOff` for a "UGV".
  [[nodiscard]] bool suits(std::string_view vehicle_type) const {
    return vehicle_types.empty() || std::ranges::find(vehicle_types, vehicle_type) != vehicle_types.end();
  }
};

class PlatformTask;

/// Something in a block, or between two, that hardly makes sense. For warnings: what may be meant all the same runs.
struct Doubt {
  std::optional<std::size_t> call;  ///< which `add` of the block, counted from 0; nothing: the block as a whole
  std::string what;
  std::string hint = {};
};

/// Collects the commands of one block. Arguments arrive complete (fallbacks filled in) and of the declared types.
class BuilderSession {
 public:
  virtual ~BuilderSession() = default;
  /// `command` and `overload` index the builder's table.
  virtual base::Result<> add(std::size_t command, std::size_t overload, std::span<Argument const> arguments) = 0;
  virtual base::Result<std::shared_ptr<PlatformTask const>> finish() = 0;
  /// What of the commands so far hardly makes sense, whatever vehicle carries them out.
  [[nodiscard]] virtual std::vector<Doubt> doubts() const { return {}; }
};

/// A block word of the language that a platform adds, e.g. `mission { ... }`.
struct BuilderSpec {
  std::string_view name;
  std::vector<CommandSpec> commands;
  std::string_view doc;
  std::function<std::unique_ptr<BuilderSession>()> begin;
};

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
  std::optional<double> relative_alt_m = {};  ///< above its home; nothing while unknown
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

/// One named value of a raw message. A text stands for the number that the protocol gives that name.
struct MessageField {
  std::string name;
  Argument value;
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

  /// Block words and commands; the same for the whole life of the platform.
  [[nodiscard]] virtual std::span<BuilderSpec const> builders() const = 0;
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

  /// Sends the vehicle one message of the platform's protocol, raw: `sendMessage v, 'COMMAND_LONG', command: 400`.
  /// Returns without waiting for any answer. Errors: not_found (with what may have been meant) or invalid_input for a
  /// message or field that there is not, or a value that does not fit it; the kinds of a link's errors.
  [[nodiscard]] virtual base::Result<> send_message(VehicleId const& id, std::string_view message,
                                                    std::span<MessageField const> fields) {
    (void)id, (void)message, (void)fields;
    return base::fail(base::ErrorKind::refused, "these vehicles take no raw messages");
  }

  /// Starts `task` on the vehicle. Never blocks; every failure shows in the run.
  [[nodiscard]] virtual std::unique_ptr<TaskRun> start(std::shared_ptr<PlatformTask const> task,
                                                       VehicleId const& id) = 0;
  /// Ends when every stop that was asked for has been confirmed by its vehicle, or has failed with a logged reason.
  [[nodiscard]] virtual base::Task<void> settle() = 0;
};

}  // namespace lapwing::tasks
