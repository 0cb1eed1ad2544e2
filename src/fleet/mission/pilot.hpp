#pragma once

#include <memory>
#include <vector>

#include "base/async/notifier.hpp"
#include "base/async/task.hpp"
#include "fleet/mission/mission_run.hpp"

namespace lapwing::fleet {

/// The one who commands a vehicle: runs one mission at a time on it, ends it when the vehicle is lost, and puts the
/// vehicle to rest after a stop. A rover whose mission is done is parked: held and disarmed, for it would stay armed in
/// its mission mode for ever.
///
/// `start` and `stop` are called from outside its own coroutines, at any time.
class Pilot {
 public:
  /// `settled` is notified when the vehicle has been put to rest. References outlive the pilot.
  Pilot(RunContext context, base::Notifier& settled) : context_(context), settled_(settled) {}
  Pilot(Pilot const&) = delete;
  Pilot& operator=(Pilot const&) = delete;

  /// Takes the vehicle from whatever mission of ours it flies. The record tells what becomes of the new one.
  std::shared_ptr<RunRecord const> start(plan::Mission mission);
  /// Ends the run, if it is still on its way. An upload is cancelled at once; a vehicle that flies is put into the stop
  /// mode unless the next `start` comes within this turn of the loop.
  void stop(RunRecord const& run, OnStop on_stop);
  /// The same for whatever run is on its way.
  void stop(OnStop on_stop);

  /// Gives the vehicle up to somebody else, who commands it from now on: ends the run and the rest after one, and sends
  /// nothing but the end of an upload and what clears the parts of plans that it has left.
  void yield(std::string reason);

  [[nodiscard]] bool is_flying() const { return run_ && run_->outcome == RunRecord::Outcome::running; }
  /// The vehicle is being put to rest.
  [[nodiscard]] bool is_settling() const { return is_settling_; }
  /// Every run, oldest first.
  [[nodiscard]] std::vector<std::shared_ptr<RunRecord const>> const& runs() const { return runs_; }

 private:
  base::Task<> fly(plan::Mission mission);
  base::Task<> guard();
  base::Task<> rest(OnStop on_stop, bool flies);
  base::Task<> bring_down(OnStop on_stop, bool flies);
  base::Task<> discard_parts();
  base::Task<> park();
  base::Task<> tidy();
  void end(RunRecord::Outcome outcome, std::string error);
  void begin_rest(OnStop on_stop);
  void begin_parking();
  void be_settled();
  void begin_tidying();

  RunContext context_;
  base::Notifier& settled_;
  std::shared_ptr<RunRecord> run_;  // shared with those who look at the run, and who may outlive it or not
  std::vector<std::shared_ptr<RunRecord const>> runs_;
  bool is_settling_ = false;
  base::Task<> flight_;
  base::Task<> guard_;
  base::Task<> rest_;
  base::Task<> words_;  ///< says what the run or the rest waits for
  base::Task<> tidy_;   ///< the vehicle is not ours while it runs, or not there
};

}  // namespace lapwing::fleet
