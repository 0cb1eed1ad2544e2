#pragma once

#include "base/config.hpp"
#include "bus/participant/bus.hpp"

namespace lapwing::apps {

/// The table `[bus]`, which all programs on a vehicle read.
void read_bus(base::ConfigReader& root, bus::BusOptions& bus);

}  // namespace lapwing::apps
