#include "map/store/schema/migrate.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "map/store/schema/geopackage.hpp"
#include "map/store/schema/tables.hpp"

namespace lapwing::map::schema {

namespace {

using base::ErrorKind;
using sql::Dialect;

base::Result<std::set<std::string>> columns_of(sql::Database& database, std::string const& table) {
  auto const rows = sql::rows_of(database, sql::columns_query(database.dialect()), {table});
  if (!rows) return std::unexpected(rows.error());
  std::set<std::string> names;
  for (auto const& row : *rows) names.insert(sql::as_text(row.front()));
  return names;
}

base::Result<> make_table(sql::Database& database, sql::Table const& table) {
  auto statements = sql::create_statements(database.dialect(), table);
  if (database.dialect() == Dialect::geopackage) statements += registration_statements(table);
  return database.execute(statements);
}

base::Result<> write_version(sql::Database& database) {
  return database.put(table::about, {"name", "value"}, {{std::string("schema_version"), std::to_string(version)}});
}

base::Result<> make_all(sql::Database& database) {
  if (database.dialect() == Dialect::geopackage)
    if (auto made = database.execute(geopackage_statements()); !made) return made;
  for (auto const* one : all_tables())
    if (auto made = make_table(database, *one); !made) return made;
  if (auto put = database.put(table::revision, {"one", "revision"}, {{std::int64_t{1}, std::int64_t{0}}}); !put)
    return put;
  return write_version(database);
}

/// Pictures were all JPEG.
base::Result<> tell_kinds_of_pictures(sql::Database& database) {
  return database.execute(
      "ALTER TABLE blobs ADD COLUMN media_type TEXT NOT NULL DEFAULT 'image/jpeg';"
      "CREATE INDEX blobs_by_at_ns ON blobs (at_ns);");
}

base::Result<> keep_the_past_of_grids(sql::Database& database) {
  return make_table(database, table::tile_shades);
}

/// From one version to the next; `steps[0]` leads from 1 to 2.
using Step = base::Result<> (*)(sql::Database& database);
constexpr Step steps[] = {tell_kinds_of_pictures, keep_the_past_of_grids};
static_assert(std::size(steps) == version - 1);

/// A property that features have learnt since is a column that may be empty, and no other version.
base::Result<> add_missing_columns(sql::Database& database) {
  for (auto const layer : all_layers) {
    auto const& table = layer_table(layer);
    auto const present = columns_of(database, table.name);
    if (!present) return std::unexpected(present.error());
    for (auto const& column : table.columns) {
      if (present->contains(column.name)) continue;
      auto const added = database.execute(sql::add_column_statement(database.dialect(), table, column));
      if (!added) return added;
    }
  }
  return {};
}

/// Nothing: there is no store in it yet.
base::Result<std::optional<int>> version_of(sql::Database& database, std::string const& name) {
  auto const columns = columns_of(database, table::about.name);
  if (!columns) return std::unexpected(columns.error());
  if (columns->empty()) return std::nullopt;
  auto const value =
      sql::value_of(database, "SELECT value FROM lapwing_store WHERE name = $1", {std::string("schema_version")});
  if (!value) return std::unexpected(value.error());
  auto const text = sql::as_text(*value);
  int number = 0;
  auto const [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc() || end != text.data() + text.size() || number < 1)
    return base::fail(ErrorKind::invalid_input, fmt::format("{}: its version is \"{}\", which is none", name, text),
                      "restore it from a backup");
  return number;
}

std::unexpected<base::Error> from_the_future(std::string const& name, int found) {
  return base::fail(
      ErrorKind::refused,
      fmt::format("{}: the store is of version {}, and this program knows up to {}", name, found, version),
      "use the newer program that has written it");
}

base::Result<> bring_up(sql::Database& database, int from) {
  for (int reached = from; reached < version; ++reached)
    if (auto done = steps[reached - 1](database); !done) return done;
  if (auto added = add_missing_columns(database); !added) return added;
  return from == version ? base::Result<>() : write_version(database);
}

/// The lock ends with the transaction: of several stations that start at once one makes the tables.
base::Result<> prepare_server(sql::Database& database) {
  if (auto locked = database.execute("SELECT pg_advisory_xact_lock(7310868735422394733)"); !locked) return locked;
  // Asked first: who has no right to make one may still use it.
  auto const there = sql::value_of(database, "SELECT count(*) FROM pg_namespace WHERE nspname = 'lapwing'");
  if (!there) return std::unexpected(there.error());
  if (sql::as_integer(*there) == 0)
    if (auto made = database.execute("CREATE SCHEMA lapwing"); !made) return made;
  return database.execute("CREATE EXTENSION IF NOT EXISTS postgis SCHEMA public");
}

/// Of an SQLite file that has no store in it.
base::Result<bool> is_empty(sql::Database& database) {
  if (database.dialect() != Dialect::geopackage) return true;  // the tables have a schema of their own
  auto const tables = sql::value_of(database, "SELECT count(*) FROM sqlite_master");
  if (!tables) return std::unexpected(tables.error());
  return sql::as_integer(*tables) == 0;
}

}  // namespace

base::Result<> prepare(sql::Database& database, std::string const& name) {
  auto transaction = sql::Transaction::begin(database);
  if (!transaction) return std::unexpected(transaction.error());
  if (database.dialect() == Dialect::postgis)
    if (auto prepared = prepare_server(database); !prepared) return prepared;
  auto const found = version_of(database, name);
  if (!found) return std::unexpected(found.error());
  if (*found && **found > version) return from_the_future(name, **found);
  auto const empty = *found ? base::Result<bool>(false) : is_empty(database);
  if (!empty) return std::unexpected(empty.error());
  if (!*found && !*empty)
    return base::fail(ErrorKind::invalid_input, fmt::format("{}: there is something else in it than a store", name),
                      "name another place; `lapwing store import` takes in other files");
  auto const done = *found ? bring_up(database, **found) : make_all(database);
  if (!done) return done;
  if (auto committed = transaction->commit(); !committed) return committed;
  // Other programs look for the marks of a GeoPackage in the file itself, not in the log beside it.
  if (database.dialect() == Dialect::geopackage) return database.execute("PRAGMA wal_checkpoint(PASSIVE)");
  return {};
}

base::Result<> check(sql::Database& database, std::string const& name) {
  auto const found = version_of(database, name);
  if (!found) return std::unexpected(found.error());
  if (!*found) return base::fail(ErrorKind::invalid_input, fmt::format("{}: there is no store in it", name));
  if (**found > version) return from_the_future(name, **found);
  if (**found == version) return {};
  return base::fail(ErrorKind::refused, fmt::format("{}: the store is of version {}, an older one", name, **found),
                    "`lapwing store compact` or a station brings it up to date");
}

}  // namespace lapwing::map::schema
