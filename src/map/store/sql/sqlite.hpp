#pragma once

#include <filesystem>
#include <memory>

#include "map/store/sql/database.hpp"

namespace lapwing::map::sql {

enum class Access { read, write };

/// A GeoPackage or any other SQLite file. To write it is made if it is not there, with a write-ahead log: those who
/// read see whole transactions and hold up nobody.
///
/// A commit has reached the disk when it returns (`synchronous=FULL`): what the store calls accepted survives the loss
/// of power, not only of the process. In batches that costs a tenth of the rate.
[[nodiscard]] base::Result<std::unique_ptr<Database>> open_sqlite(std::filesystem::path const& file, Access access);

}  // namespace lapwing::map::sql
