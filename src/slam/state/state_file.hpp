#pragma once

#include <string>
#include <string_view>

#include "base/error.hpp"
#include "slam/state/saved_map.hpp"

namespace lapwing::slam {

/// The bytes of a saved mapping, as docs/reference/slam.md has them. Equal mappings give equal bytes.
/// Precondition: scans were not gathered (RobotKind::is_sparse), for what they were joined to is no scan.
[[nodiscard]] std::string write_state(Graph const& graph, MapMemory const& memory);

/// What `write_state` wrote, to the last bit; the key frames' points are found anew in their scans. Errors
/// (invalid_input): no such file; a newer version; cut off; damaged; numbers that no mapping has.
[[nodiscard]] base::Result<SavedMap> read_state(std::string_view bytes);

}  // namespace lapwing::slam
