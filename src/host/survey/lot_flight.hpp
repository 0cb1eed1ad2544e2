#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "autonomy/interface/state.hpp"
#include "autonomy/words/lot_task.hpp"
#include "base/async/loop.hpp"
#include "host/survey/survey_desk.hpp"

namespace lapwing::host {

/// What became of a `lot` block.
struct LotRecord {
  enum class Outcome { running, done, failed };
  Outcome outcome = Outcome::running;
  std::string error = {};
  bool is_drone_at_fault = false;  ///< when failed: it was the drone or the way to it, not what it was told
  std::string progress = {};       ///< what it is about
};

/// Has one survey drone carry out the steps of a `lot` block: tells it what its operation states take
/// (docs/reference/operation-states.md), and watches what it says. Whatever it does by itself, coming home among it,
/// ends the block.
class LotFlight {
 public:
  /// `loop` and `desk` outlive this. `patience`: for a drone that is not reached.
  LotFlight(base::Loop& loop, SurveyDesk& desk, std::string drone, std::shared_ptr<autonomy::LotTask const> task,
            base::Duration patience);

  [[nodiscard]] std::shared_ptr<LotRecord> const& record() const { return record_; }
  /// Once; to its end, which is in the record.
  [[nodiscard]] base::Task<> fly();

  /// So near to a place a drone is there.
  static constexpr double arrived_m = 3.0;

 private:
  using Heartbeat = autonomy::report::Heartbeat;
  using Looks = std::function<bool(Heartbeat const&)>;

  [[nodiscard]] base::Task<base::Result<>> carry_out(autonomy::Step step);
  [[nodiscard]] base::Task<base::Result<>> arm();
  [[nodiscard]] base::Task<base::Result<>> take_off();
  [[nodiscard]] base::Task<base::Result<>> explore();
  [[nodiscard]] base::Task<base::Result<>> move(autonomy::MoveStep step);
  [[nodiscard]] base::Task<base::Result<>> wait(base::Duration time);
  [[nodiscard]] base::Task<base::Result<>> come_home();

  /// Tells the drone something that brings it from `from` into one of `into`, as its heartbeat shows within `at_most`:
  /// it comes twice a second, and when the state has changed.
  [[nodiscard]] base::Task<base::Result<>> ask(std::string command, autonomy::States from, autonomy::States into,
                                               base::Duration at_most = std::chrono::seconds(5));
  /// Until `is_there`, as long as the drone is in one of `states`; `what` it does meanwhile is for people. Errors: lost
  /// when it is not reached or comes down by itself; refused when it does something else; timed_out.
  [[nodiscard]] base::Task<base::Result<>> until(Looks is_there, autonomy::States states, base::Duration at_most,
                                                 std::string_view what);
  [[nodiscard]] bool is_in(autonomy::States states) const;
  /// Where the drone would be if it were there: in the frame of where it was armed. Error: it does not tell where it
  /// is.
  [[nodiscard]] base::Result<geo::Point<autonomy::ArmingFrame>> local_place(geo::Wgs84 const& place) const;
  /// What the drone has said since it was told something.
  [[nodiscard]] std::vector<std::string> words_since_told() const;
  [[nodiscard]] bool has_given_up_arming() const;
  /// ": " and the last that the drone has said since it was told something; empty: nothing.
  [[nodiscard]] std::string said() const;

  base::Loop& loop_;
  SurveyDesk& desk_;
  std::string drone_;
  std::shared_ptr<autonomy::LotTask const> task_;
  base::Duration patience_;
  std::shared_ptr<LotRecord> record_ = std::make_shared<LotRecord>();
  base::UtcTime told_at_{};
};

}  // namespace lapwing::host
