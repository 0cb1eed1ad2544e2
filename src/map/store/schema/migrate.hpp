#pragma once

#include <string>

#include "map/store/sql/database.hpp"

namespace lapwing::map::schema {

/// Makes the tables in an empty database; brings those of an older version up to this one, whole or not at all. `name`
/// is the store's, for messages. Errors: refused for one of a newer program; invalid_input for a database that has
/// something else in it; those of the database.
[[nodiscard]] base::Result<> prepare(sql::Database& database, std::string const& name);
/// For who only reads: errors as above, and refused for an older one.
[[nodiscard]] base::Result<> check(sql::Database& database, std::string const& name);

}  // namespace lapwing::map::schema
