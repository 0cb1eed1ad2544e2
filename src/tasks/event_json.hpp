#pragma once

#include <string>
#include <string_view>

#include "tasks/task_view.hpp"

namespace lapwing::tasks {

/// One line of JSON without its line end: `{"t":0.1,"event":"START","task":"A","vehicle":"a1"}`, t in seconds of loop
/// time. "detail" is added where there is one, then `more`: members of a platform's own, as `"items":[...]`.
[[nodiscard]] std::string to_json_line(TaskEvent const& event, std::string_view more = {});

}  // namespace lapwing::tasks
