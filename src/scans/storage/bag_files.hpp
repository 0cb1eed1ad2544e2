#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scans/storage/bag_listener.hpp"

namespace lapwing::scans {

/// Whether `path` is a recording of ROS 2 by its content: a file of either storage, or a folder.
[[nodiscard]] bool is_bag(std::filesystem::path const& path);

/// The files of a bag in the order in which they were recorded: `path` itself, or those of the folder, as its
/// metadata.yaml lists them, or, where it has none, the only one with a name that ends in .db3 or .mcap. Errors:
/// not_found, invalid_input.
[[nodiscard]] base::Result<std::vector<std::filesystem::path>> bag_files(std::filesystem::path const& path);

/// Reads one file of either storage. What the remark says is missing or damaged. Errors: those of the storages; io.
[[nodiscard]] base::Result<BagRemark> read_bag_file(std::filesystem::path const& file, BagListener& listener);

}  // namespace lapwing::scans
