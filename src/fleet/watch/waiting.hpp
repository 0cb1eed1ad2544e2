#pragma once

#include <memory>
#include <string>

#include "base/async/task.hpp"
#include "fleet/mission/mission_run.hpp"

namespace lapwing::fleet {

/// "nothing heard from it for 8 s on udpin://0.0.0.0:14550 from 10.0.0.7:14550" when it has been silent for longer than
/// a heartbeat takes; else empty.
[[nodiscard]] std::string silence_text(mavlink::Connection const& connection, MavlinkVehicle const& craft);

/// Says in the log what a run waits for and for how long, before its mission has begun: after three seconds in which
/// nothing went on, and then every ten. Ends when the mission has begun or the run is over.
base::Task<> tell_waiting(RunContext context, std::shared_ptr<RunRecord const> run);

/// The same of a vehicle that is to be stopped and does not confirm it; goes on until it is destroyed.
base::Task<> tell_stopping(RunContext context);

}  // namespace lapwing::fleet
