#pragma once

#include <string>
#include <vector>

#include "map/store/sql/table.hpp"

namespace lapwing::map::sql {

/// The places where SQLite with GeoPackage and PostgreSQL with PostGIS differ in words.
enum class Dialect { geopackage, postgis };

/// With its indices, but for what GeoPackage's own tables say of it (`schema/geopackage.hpp`).
[[nodiscard]] std::string create_statements(Dialect dialect, Table const& table);
[[nodiscard]] std::string add_column_statement(Dialect dialect, Table const& table, Column const& column);
/// The names of the columns that a table has; $1 is the table. No rows: there is no such table.
[[nodiscard]] std::string columns_query(Dialect dialect);
/// A condition on a shape's box ($1 to $4: least and most longitude, least and most latitude) that an index answers.
[[nodiscard]] std::string in_box(Dialect dialect, Table const& table);

/// "a, b, c"
[[nodiscard]] std::string comma_separated(std::vector<std::string> const& names);
/// "$1, $2, $3"
[[nodiscard]] std::string placeholders(std::size_t count);

}  // namespace lapwing::map::sql
