#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/async/task.hpp"
#include "base/log.hpp"
#include "fleet/actions/vehicle_actions.hpp"
#include "fleet/mission/mission_end.hpp"
#include "fleet/plausibility/situation.hpp"
#include "fleet/state/mavlink_vehicle.hpp"
#include "mavlink/connection/connection.hpp"
#include "mavlink/exchange/plan_replacement.hpp"
#include "plan/estimate.hpp"
#include "plan/mission.hpp"
#include "plan/plausibility/settings.hpp"

namespace lapwing::fleet {

/// One mission on its way on one vehicle, for whoever looks at it.
struct RunRecord {
  enum class Outcome { running, done, failed, stopped };
  std::string mission;
  int items = 0;  ///< as uploaded, the home item included; 0 until it came to that
  Outcome outcome = Outcome::running;
  std::string progress;
  std::string error;            ///< why, when failed or stopped
  bool vehicle_failed = false;  ///< when failed: the vehicle or the way to it broke down, not the mission
  /// From when the mission was begun, beside what was expected; grows until the run ends.
  std::optional<plan::Flown> flown;

  std::vector<geo::Wgs84> lands_at = {};  ///< where it will come down, for other vehicles to keep clear of

  // What a stop has to undo.
  mavlink::Replacement upload;            ///< of the plan that the vehicle held
  bool may_have_armed = false;            ///< it was disarmed before
  bool has_begun = false;                 ///< a heartbeat has confirmed the mission mode
  Aftermath aftermath = Aftermath::none;  ///< when it failed after it had begun
  bool took_over = false;                 ///< when it was started, the vehicle flew another mission of ours

  // Where `flown` counts from.
  base::TimePoint begun{};
  double path_before_m = 0.0;
};
[[nodiscard]] std::string_view to_string(RunRecord::Outcome outcome);

struct RunOptions {
  OnStop on_stop = OnStop::loiter;
  base::Duration ready_timeout =
      std::chrono::seconds(90);                    ///< ArduPilot's estimator takes about 45 s after a cold start
  bool verifies = true;                            ///< reads the mission back and compares before the start
  plan::plausibility::Settings plausibility = {};  ///< what is refused, and what somebody has allowed
  Neighbours neighbours = {};                      ///< the other vehicles; empty: there are none
};

/// Where a run happens. References outlive it.
struct RunContext {
  mavlink::Connection& connection;
  MavlinkVehicle& craft;
  RunOptions const& options;
  base::Logger const& log;
};

/// After a run that was given up in mid-upload: a vehicle must not keep a part of one plan and a part of another, so
/// its plan is cleared. Tells what is left.
base::Task<mavlink::PlanLeft> clear_part_of_plan(RunContext context);

/// Flies `mission` from claim to completion (language specification 5.4, phases 1 to 7), keeping `record` up to date.
/// Ends with the reason when it failed. Watches neither for the vehicle's loss nor for a stop: whoever owns the task
/// destroys it then, and reads in the record what is left to be undone.
base::Task<base::Result<>> fly_mission(RunContext context, plan::Mission mission, RunRecord& record);

}  // namespace lapwing::fleet
