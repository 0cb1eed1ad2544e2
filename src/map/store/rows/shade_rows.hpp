#pragma once

#include <string>
#include <vector>

#include "map/store/past/shade_packing.hpp"
#include "map/store/past_grid.hpp"
#include "map/store/sql/database.hpp"
#include "map/store/store.hpp"

/// How tiles of grids looked, each once, however often it looked so.
namespace lapwing::map::rows {

/// Those that are there stay, but for one that hung on another and is now whole.
[[nodiscard]] base::Result<> write_shades(sql::Database& database, std::vector<past::PackedShades> const& all,
                                          base::UtcTime now);
/// They, and what they hang on, are needed for moments up to then.
[[nodiscard]] base::Result<> touch_shades(sql::Database& database, std::vector<std::string> const& names,
                                          base::UtcTime now);
/// Those that are there. Error, io: bytes that are none.
[[nodiscard]] base::Result<PastShades> read_shades(sql::Database& database, std::vector<std::string> const& names);
/// As they stand in lists at that moment.
[[nodiscard]] base::Result<PastGrids> grids_at(sql::Database& database, std::string const& session, base::UtcTime at);

}  // namespace lapwing::map::rows
