#pragma once

#include <optional>

#include "mavlink/wire/frame.hpp"
#include "sim/body/servo_outputs.hpp"
#include "sim/mavlink/reports.hpp"

namespace lapwing::sim {

/// What ArduPilot's sensors and outputs say beside what its flight logic reports: accelerations, turn rates, the
/// earth's field, air pressure, pulses, supply, memory, its second estimate. This program's ground side needs none of
/// it, so there is no typed message for it. Nothing for other messages.
[[nodiscard]] std::optional<mavlink::Frame> sensor_report(mavlink::MessageId id, ReportView const& view,
                                                          ServoOutputs::Pulses const& outputs);

}  // namespace lapwing::sim
