#pragma once

#include <string>
#include <vector>

namespace lapwing::map::sql {

enum class ColumnKind {
  key,  ///< a number that the database gives, the table's primary key
  boolean,
  integer,
  real,
  text,
  time,
  bytes,
  shape,
};

struct Column {
  std::string name;
  ColumnKind kind;
  bool is_required = false;
  std::string shape = {};  ///< "POINT", "POLYGON", "GEOMETRY", ...
};

/// A table as it is in both databases; `dialect.hpp` says it in the words of each.
struct Table {
  std::string name;
  std::string about;
  std::vector<Column> columns;
  std::vector<std::string> key;  ///< by which rows are put, and told apart
  std::vector<std::vector<std::string>> indices = {};
  /// Its rows end with the row of another table whose key these columns hold. Empty: with nobody's.
  struct Owner {
    std::string table = {};
    std::vector<std::string> columns = {};
  } owner = {};

  [[nodiscard]] Column const* shape_column() const {
    for (auto const& column : columns)
      if (column.kind == ColumnKind::shape) return &column;
    return nullptr;
  }
};

}  // namespace lapwing::map::sql
