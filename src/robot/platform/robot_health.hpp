#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/async/loop.hpp"
#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "robot/platform/carrier_guard.hpp"
#include "robot/watch/module_watch.hpp"
#include "robot/watch/process_use.hpp"

namespace lapwing::robot {

/// How one robot's modules do: what they say of themselves goes to the watch ten times a second, and the guard stops
/// the carrier when one is not well.
///
/// The sensors speak with each reading and the carrier when something was heard of it; mapping and planning work beside
/// the loop and say nothing while they do, so that one that hangs falls silent. Thread-bound.
class RobotHealth {
 public:
  struct Surroundings {
    base::Loop& loop;
    Body& body;
    std::string name;  ///< of the robot, for the log
    base::Logger log;
    /// What is wrong with the way to the operators; nothing where there is none to be watched.
    std::function<std::optional<std::uint16_t>()> communication;
    /// What is wrong with its eyes; nothing where it has none, and while they do not answer.
    std::function<std::optional<std::uint16_t>()> points_of_interest;
  };
  explicit RobotHealth(Surroundings surroundings);
  RobotHealth(RobotHealth const&) = delete;
  RobotHealth& operator=(RobotHealth const&) = delete;

  [[nodiscard]] CarrierGuard& guard() { return guard_; }
  [[nodiscard]] ModuleWatch const& watch() const { return watch_; }

  /// The sensors have spoken. What the carrier said with it counts at once, before anybody steers.
  void sensed(std::uint16_t code);
  /// A part that is no part of this program has said how it is.
  void heard(Module module, ModuleReport const& said) { watch_.report(module, said, around_.loop.now()); }
  /// Mapping or planning has begun to work beside the loop, until it says something again.
  void begin_work(Module module) { own(module).is_at_work = true; }
  /// Mapping or planning is done with its work, and so it is from now on.
  void say(Module module, ModuleState state, std::uint16_t code);
  /// The same while it has no work; its code alone.
  void set_code(Module module, std::uint16_t code) { own(module).code = code; }

 private:
  /// A module that this program is.
  struct Own {
    bool is_at_work = false;
    ModuleState state = ModuleState::starting;
    std::uint16_t code = 0;
  };
  [[nodiscard]] Own& own(Module module) { return module == Module::mapping ? mapping_ : planner_; }
  base::Task<> beat();
  void report_carrier();
  void report_if_it_speaks(Module module, std::function<std::optional<std::uint16_t>()> const& code);
  void report(Module module, ModuleState state, std::uint16_t code);

  Surroundings around_;
  ModuleWatch watch_;
  ProcessMeter meter_;
  Own mapping_;
  Own planner_;
  CarrierGuard guard_;
  base::Scope scope_;
};

}  // namespace lapwing::robot
