#pragma once

#include <filesystem>
#include <string_view>

#include "base/error.hpp"
#include "scans/storage/bag_listener.hpp"

namespace lapwing::scans {

[[nodiscard]] bool is_sqlite(std::string_view beginning);

/// Reads a file of rosbag2's sqlite3 storage (rosbag2_storage_sqlite3: the tables `topics` and `messages`). Of a file
/// that is cut off it reads what it gets at, and the remark says so. Errors (invalid_input): it is no such file, or
/// something in it is beyond a limit; those of the listener.
[[nodiscard]] base::Result<BagRemark> read_sqlite_bag(std::filesystem::path const& file, BagListener& listener);

}  // namespace lapwing::scans
