#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::apps {

/// Scripts larger than this are refused before they are read.
inline constexpr std::size_t max_script_bytes = 16u << 20;

/// `-` is standard input.
[[nodiscard]] base::Result<std::string> read_script(std::string const& path);
/// Replaces `path` as a whole: what was there stays until the new content is on disk.
[[nodiscard]] base::Result<> write_file(std::string const& path, std::string_view content);

/// The checkout the program was built from or started by: where examples/ and web/dist lie.
[[nodiscard]] std::filesystem::path home_directory();

}  // namespace lapwing::apps
