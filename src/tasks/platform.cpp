#include "tasks/platform.hpp"

#include <fmt/format.h>

namespace lapwing::tasks {

base::Result<> Platform::perform(InstructionCall const& call, VehicleId const& /*id*/) {
  return base::fail(base::ErrorKind::refused, fmt::format("these vehicles know no {}", call.name));
}

}  // namespace lapwing::tasks
