#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace lapwing::station {

/// Names of the `.dolphin` files in the folder itself, in order of the alphabet; hidden ones are left out, and all
/// beyond the first 1000. Empty when there is no such folder.
[[nodiscard]] std::vector<std::string> list_scripts(std::filesystem::path const& folder);

/// The text of one of them. Errors: invalid_input for what is no name of a script (a path, a hidden file), or one too
/// large; not_found; io. Links that lead out of the folder count as not found.
[[nodiscard]] base::Result<std::string> read_script(std::filesystem::path const& folder, std::string_view name);

}  // namespace lapwing::station
