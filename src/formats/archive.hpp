#pragma once

#include <filesystem>

#include "base/error.hpp"

namespace lapwing::formats {

/// Packs the files of a folder, by their names alone, into a ZIP archive: what is written as several files can then be
/// sent as one. An existing archive is replaced. Error: io.
[[nodiscard]] base::Result<> write_archive(std::filesystem::path const& folder, std::filesystem::path const& archive);

}  // namespace lapwing::formats
