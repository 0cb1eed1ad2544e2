#include "fleet/mission/pilot.hpp"

#include <functional>
#include <utility>

#include <fmt/format.h>

#include "fleet/watch/waiting.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;

using base::Task;
using vehicle::Connection;
using Outcome = RunRecord::Outcome;

std::shared_ptr<RunRecord const> Pilot::start(plan::Mission mission) {
  bool const takes_over = is_settling_ || (is_flying() && (run_->has_begun || run_->took_over));
  if (is_flying()) {
    end(Outcome::failed, "another task took the vehicle");
    flight_ = {};
  }
  rest_ = {};
  tidy_ = {};
  be_settled();
  run_ = std::make_shared<RunRecord>();
  run_->mission = mission.name;
  run_->took_over = takes_over;
  runs_.push_back(run_);
  auto const run = run_;
  flight_ = fly(std::move(mission));
  guard_ = guard();
  words_ = tell_waiting(context_, run_);
  flight_.start();
  guard_.start();
  words_.start();
  return run;
}

void Pilot::stop(RunRecord const& run, OnStop on_stop) {
  if (run_.get() == &run) stop(on_stop);
}

void Pilot::stop(OnStop on_stop) {
  if (!is_flying()) return;
  flight_ = {};  // cancels an upload
  end(Outcome::stopped, "stopped");
  // Somebody else may have taken the vehicle over since the last look at it: then it is theirs.
  bool const is_ours = !run_->has_begun || in_mission_mode(context_.craft);
  if (is_ours) begin_rest(on_stop);
}

void Pilot::yield(std::string reason) {
  rest_ = {};
  be_settled();
  if (is_flying()) {
    flight_ = {};
    end(Outcome::failed, std::move(reason));
  }
  begin_tidying();
}

Task<> Pilot::fly(plan::Mission mission) {
  auto const run = run_;
  auto flown = co_await fly_mission(context_, std::move(mission), *run);
  if (flown) {
    end(Outcome::done, {});
    begin_parking();
    co_return;
  }
  run->vehicle_failed = flown.error().kind == base::ErrorKind::lost;
  end(Outcome::failed, flown.error().message);
  // A run that got as far as the mission mode and failed was mostly taken over or ended by the vehicle, which is left
  // alone then.
  if (run->has_begun && run->aftermath == Aftermath::none) co_return;
  begin_rest(run->aftermath == Aftermath::hold ? OnStop::loiter : context_.options.on_stop);
}

/// Ends the run when the vehicle can no longer be flown, whatever the flight is waiting for.
Task<> Pilot::guard() {
  auto const run = run_;
  auto const& craft = context_.craft;
  auto const boots = craft.heard->boots;
  std::string reason;
  while (run->outcome == Outcome::running && reason.empty()) {
    if (auto const rivals = context_.connection.conflict(craft.address.system)) {
      reason =
          fmt::format("two vehicles use system id {}: {} and {}", craft.address.system, rivals->first, rivals->second);
    } else if (craft.state.links.connection == Connection::lost) {
      reason =
          fmt::format("{} lost: silent for {:.0f} s", craft.state.name, base::to_seconds(craft.connection_timeout));
    } else if (craft.heard->boots != boots && !context_.connection.is_contested(craft.address.system)) {
      reason = fmt::format("{} restarted", craft.state.name);
    } else {
      // What looks like a restart may be a second vehicle; that shows within seconds, and until then nothing is sent.
      if (craft.heard->boots != boots) flight_ = {};
      co_await context_.craft.changed.wait();
    }
  }
  if (reason.empty() || run->outcome != Outcome::running) co_return;
  flight_ = {};
  run->vehicle_failed = true;
  end(Outcome::failed, std::move(reason));
  begin_tidying();
}

void Pilot::end(Outcome outcome, std::string error) {
  run_->outcome = outcome;
  run_->error = std::move(error);
  auto& craft = context_.craft;
  if (run_->upload.left == mavlink::PlanLeft::unknown)
    craft.runs.write(As<Pilot>()).parts_left_after = craft.heard->plans_taken;
  auto line = fmt::format("{}: '{}' {}", craft.state.name, run_->mission, to_string(outcome));
  if (auto& flown = run_->flown) {
    flown->duration = context_.connection.loop().now() - run_->begun;
    flown->path_m = craft.heard->path_m - run_->path_before_m;
    if (outcome == Outcome::done) line += ": " + plan::to_text(*flown);
  }
  if (outcome == Outcome::failed) return context_.log.error(fmt::format("{}: {}", line, run_->error));
  context_.log.info(line);
}

/// What there is to undo, decided before a next run begins anew.
void Pilot::begin_rest(OnStop on_stop) {
  bool const flies_the_last = run_->took_over && in_mission_mode(context_.craft);
  bool const flies = context_.craft.asked->mission_mode_pending || run_->has_begun || flies_the_last;
  if (!flies && !run_->may_have_armed && !context_.craft.holds_parts()) return;
  is_settling_ = true;
  rest_ = rest(on_stop, flies);
  words_ = tell_stopping(context_);
  rest_.start();
  words_.start();
}

void Pilot::be_settled() {
  if (!std::exchange(is_settling_, false)) return;
  words_ = {};
  settled_.notify_all();
}

/// ArduPilot's rovers stay armed in AUTO behind the end of their mission, its planes for a while after they have
/// landed, and copters that are set up not to disarm by themselves.
void Pilot::begin_parking() {
  using enum vehicle::Family;
  auto const& craft = context_.craft;
  bool const flies = craft.state.family == plane || craft.state.family == copter;
  bool const stands = craft.state.family == rover || (flies && craft.heard->trace.on_ground_since);
  if (!stands || !craft.heard->is_armed) return;
  is_settling_ = true;
  rest_ = park();
  rest_.start();
}

Task<> Pilot::park() {
  constexpr auto next_task_has_begun = 500ms;  // some ticks of the script
  auto& craft = context_.craft;
  co_await context_.connection.loop().sleep(next_task_has_begun);
  std::function<void()> const nobody_waits;
  base::Result<> parked;
  // One that has landed stays in its mode: in another it might take off again.
  if (craft.state.family == vehicle::Family::rover)
    parked = co_await bring_to_rest(context_.connection, craft, OnStop::loiter, nobody_waits);
  ActionOptions const at_once{.is_urgent = true};
  if (parked && craft.heard->is_armed) parked = co_await disarm(context_.connection, craft, at_once);
  if (parked) {
    context_.log.info(fmt::format("{} parked: {}, disarmed", craft.state.name, craft.state.mode.value.value_or("")));
  } else {
    context_.log.error(fmt::format("{} could not be parked: {}", craft.state.name, parked.error().message));
  }
  be_settled();
}

Task<> Pilot::rest(OnStop on_stop, bool flies) {
  auto const run = run_;
  co_await context_.connection.loop()
      .turn();  // the next task on this vehicle may start in this turn and will deal with it
  if (flies || run->may_have_armed) co_await bring_down(on_stop, flies);
  if (context_.craft.holds_parts()) co_await discard_parts();
  be_settled();
}

Task<> Pilot::bring_down(OnStop on_stop, bool flies) {
  auto& craft = context_.craft;
  base::Result<> done;
  if (flies) {
    std::function<void()> const nobody_waits;
    done = co_await bring_to_rest(context_.connection, craft, on_stop, nobody_waits);
  } else {
    ActionOptions const at_once{.is_urgent = true};
    done = co_await disarm(context_.connection, craft, at_once);
  }
  if (done) {
    context_.log.info(fmt::format("{} stopped: {}", craft.state.name, craft.state.mode.value.value_or("")));
  } else {
    context_.log.error(fmt::format("{} could not be stopped: {}", craft.state.name, done.error().message));
  }
}

Task<> Pilot::discard_parts() {
  auto const left = co_await clear_part_of_plan(context_);
  auto const text = fmt::format("{}: the upload was given up: {}", context_.craft.state.name, to_string(left));
  left == mavlink::PlanLeft::unknown ? context_.log.error(text) : context_.log.info(text);
}

void Pilot::begin_tidying() {
  if (!context_.craft.holds_parts()) return;
  tidy_ = tidy();
  tidy_.start();
}

/// Moves nothing, so it may be done to a vehicle that somebody else commands, or none may command.
Task<> Pilot::tidy() {
  constexpr int tries = 3;
  auto& craft = context_.craft;
  auto const may_be_cleared = [&] {
    bool const flies_it = craft.heard->is_armed && in_mission_mode(craft);
    return craft.is_connected() && !flies_it && !context_.connection.is_contested(craft.address.system);
  };
  for (int attempt = 0; attempt < tries && craft.holds_parts(); ++attempt) {
    while (!may_be_cleared()) co_await craft.changed.wait();
    if (craft.holds_parts()) co_await discard_parts();
  }
}

}  // namespace lapwing::fleet
