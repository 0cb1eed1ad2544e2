#pragma once

#include <optional>
#include <unordered_map>
#include <utility>
#include <variant>

#include "sim/guidance/flight_context.hpp"
#include "sim/guidance/return_home.hpp"

namespace lapwing::sim {

/// Flies a mission plan item by item, as ArduPilot's AP_Mission does.
///
/// Holds its place while the vehicle is in another mode; `plan` is the vehicle's, changed by uploads while this runs.
class MissionRunner {
 public:
  explicit MissionRunner(MissionPlan const& plan) : plan_(plan) {}

  /// From the first item, forgetting jumps done.
  void restart();
  /// Entered AUTO: goes on with the item where it stopped.
  void resume();
  /// Left AUTO.
  void suspend();
  /// False when there is no such item. 0 means the first.
  bool set_current(int seq);
  /// The plan was changed under a running mission: the current command starts anew, if it is still there.
  void plan_changed(Outbox& out);
  void plan_cleared();
  /// Disarming puts the mission back to its start, but a finished one still says so.
  void disarmed();

  /// The goal at this step; moves on to the next item when one is done.
  Goal update(FlightContext const& context, Outbox& out);

  [[nodiscard]] int current() const { return current_; }
  [[nodiscard]] mavlink::MissionState state() const;
  [[nodiscard]] bool running() const { return running_; }
  /// Every item was flown.
  [[nodiscard]] bool complete() const { return complete_; }
  /// The last item that was flown brought the vehicle to the ground.
  [[nodiscard]] bool landed() const { return landed_; }
  /// The first navigation command lifts a copter off the ground.
  [[nodiscard]] bool starts_with_take_off() const;

  /// Wishes of "do" commands, taken by the autopilot.
  [[nodiscard]] std::optional<double> take_speed() { return std::exchange(speed_m_s_, std::nullopt); }
  [[nodiscard]] std::optional<geo::Ned> take_home() { return std::exchange(home_, std::nullopt); }
  [[nodiscard]] std::optional<bool> take_fence() { return std::exchange(fence_, std::nullopt); }
  /// A plane leaves AUTO for RTL when the mission says "return to launch"; the others fly that item within AUTO.
  [[nodiscard]] bool take_return() { return std::exchange(wants_return_, false); }
  [[nodiscard]] std::optional<double> yaw_rad() const { return yaw_rad_; }

 private:
  struct Run {
    mavlink::MissionItem item;
    geo::Ned from;
    geo::Ned point;
    bool passing = false;
    std::optional<base::Duration> arrived = {};  ///< at the point
    base::Duration started{};
    double turned_rad = 0.0;
    double last_bearing_rad = 0.0;
    std::variant<std::monostate, Landing, ReturnHome> descent = {};
  };
  bool advance(FlightContext const& context, Outbox& out);
  bool jump(int& index, FlightContext const& context, Outbox& out);
  void begin(int index, FlightContext const& context, Outbox& out);
  void perform(int index, FlightContext const& context, Outbox& out);
  [[nodiscard]] bool goes_on_after(int index) const;
  void finish(FlightContext const& context, Outbox& out);
  Goal fly(FlightContext const& context, Outbox& out, bool& done);
  Goal fly_to_point(FlightContext const& context, Outbox& out, bool& done);
  Goal loiter(FlightContext const& context, bool& done);
  Goal take_off(FlightContext const& context, bool& done);
  void count_turns(FlightContext const& context);
  [[nodiscard]] bool at_point(FlightContext const& context, double radius_m) const;
  [[nodiscard]] Goal after_the_end(FlightContext const& context) const;

  MissionPlan const& plan_;
  int current_ = 0;
  int next_ = 1;  ///< where the search for the next command begins
  bool running_ = false;
  bool complete_ = false;
  bool landed_ = false;
  std::optional<Run> run_;
  std::unordered_map<int, int> jumps_done_;
  std::optional<geo::Ned> end_;
  std::optional<double> speed_m_s_;
  std::optional<geo::Ned> home_;
  std::optional<bool> fence_;
  std::optional<double> yaw_rad_;
  bool wants_return_ = false;
};

}  // namespace lapwing::sim
