#pragma once

#include "sim/guidance/flight_context.hpp"
#include "sim/model/parameter_table.hpp"

namespace lapwing::sim {

/// The speeds that the parameters ask for, in SI.
[[nodiscard]] Pace pace_from(Kind const& kind, ParameterTable const& parameters);
/// The distances and times that the parameters ask for, in SI.
[[nodiscard]] Tuning tuning_from(Kind const& kind, ParameterTable const& parameters);

}  // namespace lapwing::sim
