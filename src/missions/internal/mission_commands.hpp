#pragma once

#include <span>
#include <vector>

#include "plan/mission_builder.hpp"
#include "tasks/platform.hpp"

namespace lapwing::missions::internal {

/// What a command does with its complete arguments; `overload` as in its spec.
using Apply = base::Result<> (*)(plan::MissionBuilder& builder, std::size_t overload,
                                 std::span<tasks::Argument const> arguments);

struct MissionCommand {
  tasks::CommandSpec spec;
  Apply apply;
};

/// Commands to somewhere: homes, waypoints, take-offs, loiters, landings, surveys.
[[nodiscard]] std::vector<MissionCommand> movement_commands();
/// Commands on the way: name, speed, delay, photos, jumps.
[[nodiscard]] std::vector<MissionCommand> other_commands();

// Readers of arguments that the language has checked against the parameters.
[[nodiscard]] double number(tasks::Argument const& argument);
[[nodiscard]] int integer(tasks::Argument const& argument);
[[nodiscard]] std::string const& text(tasks::Argument const& argument);
[[nodiscard]] geo::Wgs84 position(tasks::Argument const& argument);

}  // namespace lapwing::missions::internal
