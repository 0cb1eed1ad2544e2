#pragma once

#include <string>

namespace lapwing::autonomy {

/// The states and the table of transitions as the reference page has them (docs/reference/operation-states.md), in
/// Markdown, with a diagram in Mermaid.
[[nodiscard]] std::string states_page();

}  // namespace lapwing::autonomy
