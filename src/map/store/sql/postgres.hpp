#pragma once

#include <memory>
#include <string>

#include "map/store/sql/database.hpp"
#include "map/store/sql/sqlite.hpp"

namespace lapwing::map::sql {

/// A PostgreSQL server with PostGIS; the tables lie in a schema of their own, `lapwing`. `name` is for messages: the
/// address without its password.
///
/// A connection that was lost is made anew with the next transaction, or statement outside of one. Rows that are put
/// go in one pipeline: a batch costs few times to the server and back, not one for each row.
[[nodiscard]] base::Result<std::unique_ptr<Database>> open_postgres(std::string const& address, std::string const& name,
                                                                    Access access);

}  // namespace lapwing::map::sql
