#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::base {

/// Who may read a file, besides those whom the process's umask keeps out.
enum class Readers : std::uint8_t { all, owner };

/// Puts a file with that content in place of what `path` names. Whatever ends the process, or the power, afterwards
/// either the old content is there whole or the new one: the new one is written beside it as `path` with `.part`, and
/// takes its name when it is on the disk. When this returns without an error the name is on the disk, too. Error (io):
/// it cannot be written; what was there is still there, and nothing beside it.
[[nodiscard]] Result<> replace_file(std::filesystem::path const& path, std::string_view content,
                                    Readers readers = Readers::all);

}  // namespace lapwing::base
