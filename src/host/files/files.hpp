#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace lapwing::host {

/// Scripts larger than this are refused before they are read.
inline constexpr std::size_t max_script_bytes = 16u << 20;

/// `-` is standard input.
[[nodiscard]] base::Result<std::string> read_script(std::string const& path);
struct ScriptText {
  std::string name;  ///< its path
  std::string text;
};
/// All of them or none.
[[nodiscard]] base::Result<std::vector<ScriptText>> read_scripts(std::vector<std::string> const& paths);

/// The checkout the program was built from or started by: where examples/ and web/dist lie.
[[nodiscard]] std::filesystem::path home_directory();

}  // namespace lapwing::host
