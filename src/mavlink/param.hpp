#pragma once

#include <string>

#include "mavlink/connection.hpp"

namespace lapwing::mavlink {

struct ParamOptions {
  int tries = 5;
  base::Duration reply_timeout = std::chrono::milliseconds(1000);
};

/// The parameter's value, whatever its type ("C cast" encoding). Error: timed_out also for a name that the vehicle does
/// not know, since ArduPilot then stays silent.
base::Task<base::Result<ParamValue>> read_param(Connection& connection, Address target, std::string name,
                                                ParamOptions options = {});

/// Sets it and makes sure that the vehicle stored it. Errors: refused when it stored another value (limits, rounding),
/// timed_out.
base::Task<base::Result<>> set_param(Connection& connection, Address target, std::string name, float value,
                                     ParamOptions options = {});

}  // namespace lapwing::mavlink
