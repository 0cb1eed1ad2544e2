#include "map/store/sql/database.hpp"

namespace lapwing::map::sql {

base::Result<std::vector<Row>> rows_of(Database& database, std::string const& statement, Row const& values) {
  std::vector<Row> rows;
  auto const read = database.query(statement, values, [&](Row const& row) -> base::Result<> {
    rows.push_back(row);
    return {};
  });
  if (!read) return std::unexpected(read.error());
  return rows;
}

base::Result<Value> value_of(Database& database, std::string const& statement, Row const& values) {
  auto const rows = rows_of(database, statement, values);
  if (!rows) return std::unexpected(rows.error());
  return rows->empty() || rows->front().empty() ? Value() : rows->front().front();
}

}  // namespace lapwing::map::sql
