#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "base/wall_clock.hpp"
#include "map/store/care/care.hpp"
#include "map/store/reader.hpp"
#include "map/store/schema/migrate.hpp"
#include "map/store/schema/tables.hpp"
#include "map/store/sql/wkb.hpp"

namespace lapwing::map::care {

namespace {

using sql::Column;
using sql::ColumnKind;
using sql::Row;
using sql::Table;

/// Rows at a time: pieces of the past may have some megabytes.
constexpr std::int64_t page = 100;

/// What a column of that kind has in either database, as the other one wants it.
base::Result<sql::Value> converted(Column const& column, sql::Value const& value) {
  auto const given = [](auto const& found) { return found ? sql::Value(*found) : sql::Value(); };
  if (sql::is_null(value)) return sql::Value();
  switch (column.kind) {
    case ColumnKind::boolean: return given(sql::as_bool(value));
    case ColumnKind::real: return given(sql::as_real(value));
    case ColumnKind::time: return given(sql::as_time(value));
    case ColumnKind::bytes: return sql::Value(sql::Bytes{sql::as_bytes(value)});
    case ColumnKind::key:
    case ColumnKind::integer:
    case ColumnKind::text: return value;
    case ColumnKind::shape: break;
  }
  auto const shape = sql::unwrap(sql::as_bytes(value));
  if (!shape) return base::fail(base::ErrorKind::io, "a geometry cannot be read");
  return sql::Value(*shape);
}

std::vector<Column> copied_columns(Table const& table) {
  auto columns = table.columns;
  std::erase_if(columns, [](Column const& column) { return column.kind == ColumnKind::key; });
  return columns;
}

std::vector<std::string> names_of(std::vector<Column> const& columns) {
  std::vector<std::string> names;
  for (auto const& column : columns) names.push_back(column.name);
  return names;
}

class Copy {
 public:
  Copy(Reader& from, sql::Database& to, blobs::Bytes& to_bytes) : from_(from), to_(to), to_bytes_(to_bytes) {}

  base::Result<Copied> all() {
    auto transaction = sql::Transaction::begin(to_);
    if (!transaction) return std::unexpected(transaction.error());
    for (auto const* one : schema::all_tables()) {
      // The version is the other one's own, and the bytes of pictures come with their rows.
      if (one == &schema::table::about || one == &schema::table::blob_bytes) continue;
      if (auto copied = table(*one); !copied) return std::unexpected(copied.error());
    }
    if (auto committed = transaction->commit(); !committed) return std::unexpected(committed.error());
    return std::move(copied_);
  }

 private:
  base::Result<> table(Table const& table) {
    auto const columns = copied_columns(table);
    // By the key, behind the last one: what a server answers in one piece stands in memory.
    auto const key = sql::comma_separated(table.key);
    auto const select = fmt::format("SELECT {} FROM {}", sql::comma_separated(names_of(columns)), table.name);
    auto const order = fmt::format("ORDER BY {} LIMIT {}", key, page);
    auto const first = fmt::format("{} {}", select, order);
    auto const next = fmt::format("{} WHERE ({}) > ({}) {}", select, key, sql::placeholders(table.key.size()), order);
    Row last_key;
    for (;;) {
      auto const found = sql::rows_of(*from_.database, last_key.empty() ? first : next, last_key);
      if (!found) return std::unexpected(found.error());
      if (found->empty()) return {};
      auto rows = converted_rows(table, columns, *found);
      if (!rows) return std::unexpected(rows.error());
      if (&table == &schema::table::blobs) {
        if (auto copied = pictures(*rows); !copied) return copied;
      } else if (auto put = to_.put(table, names_of(columns), *rows); !put) {
        return put;
      }
      copied_.rows += rows->size();
      last_key = key_of(table, columns, found->back());
    }
  }

  static base::Result<std::vector<Row>> converted_rows(Table const& table, std::vector<Column> const& columns,
                                                       std::vector<Row> const& found) {
    std::vector<Row> rows;
    for (auto const& row : found) {
      auto& made = rows.emplace_back();
      for (std::size_t i = 0; i < columns.size(); ++i) {
        auto value = converted(columns[i], row[i]);
        if (!value)
          return base::fail(value.error().kind, fmt::format("{}: {}", table.name, value.error().message),
                            "`lapwing store verify` tells which");
        made.push_back(std::move(*value));
      }
    }
    return rows;
  }

  static Row key_of(Table const& table, std::vector<Column> const& columns, Row const& row) {
    Row key;
    for (auto const& name : table.key) {
      auto const at = std::ranges::find(columns, name, &Column::name) - columns.begin();
      key.push_back(row[static_cast<std::size_t>(at)]);
    }
    return key;
  }

  /// The rows with their bytes; those without stay behind.
  base::Result<> pictures(std::vector<Row>& rows) {
    auto const names = names_of(copied_columns(schema::table::blobs));
    for (auto const& row : rows) {
      auto const hash = sql::as_text(row.front());
      auto const blob = blobs::read(*from_.database, *from_.bytes, hash);
      if (!blob) {
        copied_.faults.push_back(blob.error().message);
        continue;
      }
      bool const is_in_table = to_.dialect() == sql::Dialect::postgis;
      if (!is_in_table)
        if (auto written = to_bytes_.write(hash, blob->bytes); !written) return written;
      if (auto put = to_.put(schema::table::blobs, names, {row}); !put) return put;
      if (is_in_table)
        if (auto written = to_bytes_.write(hash, blob->bytes); !written) return written;
      ++copied_.pictures;
    }
    return {};
  }

  Reader& from_;
  sql::Database& to_;
  blobs::Bytes& to_bytes_;
  Copied copied_;
};

base::Result<> is_empty(sql::Database& database, std::string const& name) {
  for (auto const* table : schema::all_tables()) {
    if (table == &schema::table::about || table == &schema::table::revision) continue;
    auto const count = sql::value_of(database, fmt::format("SELECT count(*) FROM {}", table->name));
    if (!count) return std::unexpected(count.error());
    if (sql::as_integer(*count) != 0)
      return base::fail(base::ErrorKind::refused, fmt::format("{}: there is something in this store", name),
                        "copy to an empty one; two stores are not made one");
  }
  return {};
}

}  // namespace

base::Result<Copied> copy(std::string const& from, std::string const& to) {
  place::Address const source(from), target(to);
  auto const reader = Reader::open(source);
  if (!reader) return std::unexpected(reader.error());
  if (auto checked = schema::check(*(*reader)->database, source.name()); !checked)
    return std::unexpected(checked.error());
  std::optional<place::FolderLock> lock;
  if (!target.is_server()) {
    auto taken = place::FolderLock::take(target);
    if (!taken) return std::unexpected(taken.error());
    lock.emplace(std::move(*taken));
  }
  auto const database = place::open_database(target, sql::Access::write);
  if (!database) return std::unexpected(database.error());
  if (auto prepared = schema::prepare(**database, target.name()); !prepared) return std::unexpected(prepared.error());
  if (auto empty = is_empty(**database, target.name()); !empty) return std::unexpected(empty.error());
  auto const bytes = place::open_bytes(target, **database);
  return Copy(**reader, **database, *bytes).all();
}

}  // namespace lapwing::map::care
