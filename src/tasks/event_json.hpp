#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tasks/task_view.hpp"

namespace lapwing::tasks {

/// As one line of `--events` says it: `{"t":0.1,"event":"START","task":"A","vehicle":"a1"}`, t in seconds of loop time;
/// "detail" is added where there is one.
[[nodiscard]] nlohmann::ordered_json to_json(TaskEvent const& event);

}  // namespace lapwing::tasks
