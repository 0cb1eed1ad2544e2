#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "robot/watch/module.hpp"

namespace lapwing::robot {

struct WatchSettings {
  /// Without these the robot does not move. The visualizer and the command centre are the operator's: an outage of the
  /// link to them stops nothing. Points of interest may be done without, since a map without doors is one.
  std::vector<Module> required{Module::sensors, Module::carrier, Module::mapping, Module::planner};
  /// Three periods of the modules' reports (the seed leaves it open).
  base::Duration silence = std::chrono::milliseconds(300);
  /// So long a module must have been without a critical error. A board forgives a wheel that is blocked with the next
  /// command, the stop itself included: without this the robot would push against it again at once.
  base::Duration calm = std::chrono::seconds(2);
};

/// A module as the Health tab shows it.
struct ModuleHealth {
  Module module{};
  bool is_required = false;
  bool was_heard = false;  ///< the rest says something only then
  bool is_silent = false;
  ModuleReport report;
  double reports_per_s = 0;
  base::Duration since_heard{};
};

/// Whether the robot may move, and if not, why: for people, with the module's name.
struct Clearance {
  bool may_move = false;
  std::optional<Module> who;
  std::string reason;
  std::string what_to_do;
};

/// Who is well and who is not. Values in, values out: the moments are given.
///
/// The robot may move when every required module was heard within the watch period, is ready and has had no critical
/// error for a moment, and no kill holds. After a silence that is over it may move again by itself; after a kill only
/// `restart` lets it. Of several that are not well, one that says what is wrong is named before one that is silent,
/// which may be its consequence.
class ModuleWatch {
 public:
  explicit ModuleWatch(WatchSettings settings = {});

  void report(Module module, ModuleReport const& report, base::TimePoint now);
  void kill() { is_killed_ = true; }
  /// The operator's. Error (refused): a module is not well yet, and which; the kill then holds.
  [[nodiscard]] base::Result<> restart(base::TimePoint now);

  [[nodiscard]] bool is_killed() const { return is_killed_; }
  [[nodiscard]] Clearance clearance(base::TimePoint now) const;
  [[nodiscard]] std::vector<ModuleHealth> health(base::TimePoint now) const;

 private:
  struct Entry {
    std::optional<ModuleReport> report;
    std::deque<base::TimePoint> heard;           ///< the newest last; no more than a second back
    std::optional<base::TimePoint> critical_at;  ///< when it last said something critical
    ModuleReport critical;                       ///< what that was
  };
  [[nodiscard]] std::optional<Clearance> critical_objection(Module module, base::TimePoint now) const;
  [[nodiscard]] Clearance clearance_of_modules(base::TimePoint now) const;
  [[nodiscard]] std::optional<Clearance> objection(Module module, base::TimePoint now) const;
  [[nodiscard]] Entry const& entry(Module module) const { return entries_[static_cast<std::size_t>(module)]; }

  WatchSettings settings_;
  std::array<Entry, module_names.size()> entries_;
  bool is_killed_ = false;
};

}  // namespace lapwing::robot
