#pragma once

#include <vector>

#include "map/store/rows/feature_rows.hpp"

namespace lapwing::map::rows {

/// The site and all its floors, over what was known of it.
[[nodiscard]] base::Result<> write_site(sql::Database& database, geo::Site const& site, Revision revision);
/// Error, io: rows that make no site.
[[nodiscard]] base::Result<Sites> read_sites(sql::Database& database, Revision since = 0);

}  // namespace lapwing::map::rows
