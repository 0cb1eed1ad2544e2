#include "map/store/sql/sqlite.hpp"

#include <algorithm>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <sqlite3.h>

#include "base/assert.hpp"
#include "map/store/sql/wkb.hpp"

namespace lapwing::map::sql {

namespace {

/// How long a reader of another program, or a checkpoint, may hold us up.
constexpr int busy_timeout_ms = 5000;

struct CloseConnection {
  void operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }
};
struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Connection = std::unique_ptr<sqlite3, CloseConnection>;

struct Prepared {
  std::unique_ptr<sqlite3_stmt, Finalize> statement;
  std::vector<int> places;  ///< of $1, $2, ...; 0 for one that it does not use
};

/// What a shape's header says of its sides, which it does for all but points; else they are looked for.
std::optional<Shape> sides_of(sqlite3_value* value) {
  auto const* bytes = static_cast<char const*>(sqlite3_value_blob(value));
  if (!bytes) return std::nullopt;
  std::string_view const blob(bytes, static_cast<std::size_t>(sqlite3_value_bytes(value)));
  if (auto const told = envelope_of(blob)) return told;
  return unwrap(blob);
}

/// The four corners and emptiness of shapes, for the triggers of GeoPackage's R-tree (1.3, annex F.3).
template <double Shape::* side>
void st_side(sqlite3_context* context, int, sqlite3_value** values) {
  auto const shape = sides_of(values[0]);
  if (!shape) return sqlite3_result_null(context);
  sqlite3_result_double(context, (*shape).*side);
}

void st_is_empty(sqlite3_context* context, int, sqlite3_value** values) {
  if (sqlite3_value_type(values[0]) == SQLITE_NULL) return sqlite3_result_null(context);
  sqlite3_result_int(context, sides_of(values[0]) ? 0 : 1);
}

void define_functions(sqlite3* connection) {
  constexpr int flags = SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS;
  auto const define = [&](char const* name, void (*function)(sqlite3_context*, int, sqlite3_value**)) {
    sqlite3_create_function_v2(connection, name, 1, flags, nullptr, function, nullptr, nullptr, nullptr);
  };
  define("ST_MinX", st_side<&Shape::least_lon>);
  define("ST_MaxX", st_side<&Shape::most_lon>);
  define("ST_MinY", st_side<&Shape::least_lat>);
  define("ST_MaxY", st_side<&Shape::most_lat>);
  define("ST_IsEmpty", st_is_empty);
}

base::ErrorKind kind_of(int code) {
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED: return base::ErrorKind::timed_out;
    case SQLITE_CONSTRAINT:
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH: return base::ErrorKind::refused;
    case SQLITE_NOTADB:
    case SQLITE_ERROR:
    case SQLITE_MISMATCH: return base::ErrorKind::invalid_input;
    default: return base::ErrorKind::io;
  }
}

class Sqlite final : public Database {
 public:
  Sqlite(Connection connection, std::string name) : connection_(std::move(connection)), name_(std::move(name)) {}

  [[nodiscard]] Dialect dialect() const override { return Dialect::geopackage; }

  base::Result<> execute(std::string const& statements) override {
    // A statement that is prepared holds on to the tables that it names.
    prepared_.clear();
    int const code = sqlite3_exec(connection_.get(), statements.c_str(), nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) return fault(code);
    return {};
  }

  base::Result<> query(std::string const& statement, Row const& values, EachRow const& each) override {
    auto const ready = bound(statement, values);
    if (!ready) return std::unexpected(ready.error());
    Running const running(*ready);
    Row row(static_cast<std::size_t>(sqlite3_column_count(*ready)));
    for (;;) {
      int const code = sqlite3_step(*ready);
      if (code == SQLITE_DONE) return {};
      if (code != SQLITE_ROW) return fault(code);
      for (std::size_t i = 0; i < row.size(); ++i) row[i] = column(*ready, static_cast<int>(i));
      if (auto taken = each(row); !taken) return taken;
    }
  }

  base::Result<std::uint64_t> change(std::string const& statement, Row const& values) override {
    auto const ready = bound(statement, values);
    if (!ready) return std::unexpected(ready.error());
    Running const running(*ready);
    int code = SQLITE_ROW;
    while (code == SQLITE_ROW) code = sqlite3_step(*ready);
    if (code != SQLITE_DONE) return fault(code);
    return static_cast<std::uint64_t>(sqlite3_changes64(connection_.get()));
  }

  base::Result<> change_each(std::string const& statement, std::vector<Row> const& all) override {
    for (auto const& values : all)
      if (auto const changed = change(statement, values); !changed) return std::unexpected(changed.error());
    return {};
  }

  base::Result<> put(Table const& table, std::vector<std::string> const& columns,
                     std::vector<Row> const& rows) override {
    // Not by ON CONFLICT: its rule would take the place of the INSERT OR REPLACE in the triggers of the R-tree.
    auto const update = update_statement(table, columns);
    auto const insert = fmt::format("INSERT INTO {} ({}) VALUES ({})", table.name, comma_separated(columns),
                                    placeholders(columns.size()));
    for (auto const& row : rows) {
      auto const changed = change(update, row);
      if (!changed) return std::unexpected(changed.error());
      if (*changed > 0) continue;
      if (auto const inserted = change(insert, row); !inserted) return std::unexpected(inserted.error());
    }
    return {};
  }

  base::Result<> begin() override { return simply("BEGIN IMMEDIATE"); }
  base::Result<> commit() override { return simply("COMMIT"); }
  void roll_back() override {
    // SQLite may have done it by itself, as it does when the disk is full.
    if (sqlite3_get_autocommit(connection_.get()) == 0) (void)simply("ROLLBACK");
  }

 private:
  /// Lets go of what a statement holds when its rows have been read, or not all of them.
  struct Running {
    explicit Running(sqlite3_stmt* running) : statement(running) {}
    Running(Running const&) = delete;
    ~Running() {
      sqlite3_reset(statement);
      sqlite3_clear_bindings(statement);
    }
    sqlite3_stmt* statement;
  };

  base::Result<> simply(std::string const& statement) {
    if (auto const done = change(statement, {}); !done) return std::unexpected(done.error());
    return {};
  }

  static std::string update_statement(Table const& table, std::vector<std::string> const& columns) {
    std::string assignments, condition;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      bool const is_key = std::ranges::find(table.key, columns[i]) != table.key.end();
      auto& list = is_key ? condition : assignments;
      if (!list.empty()) list += is_key ? " AND " : ", ";
      list += fmt::format("\"{}\" = ${}", columns[i], i + 1);
    }
    if (assignments.empty()) assignments = fmt::format("\"{0}\" = \"{0}\"", columns.front());
    return fmt::format("UPDATE {} SET {} WHERE {}", table.name, assignments, condition);
  }

  base::Result<sqlite3_stmt*> bound(std::string const& statement, Row const& values) {
    auto known = prepared_.find(statement);
    if (known == prepared_.end()) {
      sqlite3_stmt* made = nullptr;
      int const code = sqlite3_prepare_v3(connection_.get(), statement.c_str(), static_cast<int>(statement.size()),
                                          SQLITE_PREPARE_PERSISTENT, &made, nullptr);
      if (code != SQLITE_OK) return fault(code);
      Prepared prepared{std::unique_ptr<sqlite3_stmt, Finalize>(made), {}};
      for (std::size_t i = 1; i <= values.size(); ++i)
        prepared.places.push_back(sqlite3_bind_parameter_index(made, fmt::format("${}", i).c_str()));
      known = prepared_.emplace(statement, std::move(prepared)).first;
    }
    auto const& [ready, places] = known->second;
    LAPWING_ASSERT(places.size() == values.size());  // one text, one number of values
    for (std::size_t i = 0; i < values.size(); ++i)
      if (places[i] != 0)
        if (int const code = bind(ready.get(), places[i], values[i]); code != SQLITE_OK) return fault(code);
    return ready.get();
  }

  /// The value outlives what is done with it: only what is made of it here is copied.
  static int bind(sqlite3_stmt* statement, int at, Value const& value) {
    auto const bytes = [&](std::string const& data, sqlite3_destructor_type lives) {
      return sqlite3_bind_blob64(statement, at, data.data(), data.size(), lives);
    };
    auto const text = [&](std::string const& words, sqlite3_destructor_type lives) {
      return sqlite3_bind_text64(statement, at, words.data(), words.size(), lives, SQLITE_UTF8);
    };
    if (auto const* truth = std::get_if<bool>(&value)) return sqlite3_bind_int(statement, at, *truth ? 1 : 0);
    if (auto const* number64 = std::get_if<std::int64_t>(&value)) return sqlite3_bind_int64(statement, at, *number64);
    if (auto const* real = std::get_if<double>(&value)) return sqlite3_bind_double(statement, at, *real);
    if (auto const* words = std::get_if<std::string>(&value)) return text(*words, SQLITE_STATIC);
    if (auto const* data = std::get_if<Bytes>(&value)) return bytes(data->data, SQLITE_STATIC);
    if (auto const* time = std::get_if<base::UtcTime>(&value)) return text(iso_time(*time), SQLITE_TRANSIENT);
    if (auto const* shape = std::get_if<Shape>(&value)) return bytes(geopackage_blob(*shape), SQLITE_TRANSIENT);
    return sqlite3_bind_null(statement, at);
  }

  static Value column(sqlite3_stmt* statement, int i) {
    auto const size = [&] { return static_cast<std::size_t>(sqlite3_column_bytes(statement, i)); };
    switch (sqlite3_column_type(statement, i)) {
      case SQLITE_INTEGER: return std::int64_t{sqlite3_column_int64(statement, i)};
      case SQLITE_FLOAT: return sqlite3_column_double(statement, i);
      case SQLITE_TEXT: {
        auto const* const words = reinterpret_cast<char const*>(sqlite3_column_text(statement, i));
        return std::string(words, size());
      }
      case SQLITE_BLOB: {
        auto const* const data = static_cast<char const*>(sqlite3_column_blob(statement, i));
        return Bytes{data ? std::string(data, size()) : std::string()};
      }
      default: return std::monostate();
    }
  }

  [[nodiscard]] std::unexpected<base::Error> fault(int code) const {
    auto const kind = kind_of(code);
    auto const primary = code & 0xff;
    auto const* const hint = primary == SQLITE_FULL      ? "make room on its disk"
                             : primary == SQLITE_CORRUPT ? "restore it from a backup; `lapwing store verify` says more"
                             : primary == SQLITE_NOTADB  ? "it is no GeoPackage: name another folder"
                             : primary == SQLITE_BUSY    ? "another program has it open to write: close it there"
                                                         : "";
    return base::fail(kind, fmt::format("{}: {}", name_, sqlite3_errmsg(connection_.get())), hint);
  }

  Connection connection_;
  std::string name_;
  std::unordered_map<std::string, Prepared> prepared_;  // ends before the connection
};

}  // namespace

base::Result<std::unique_ptr<Database>> open_sqlite(std::filesystem::path const& file, Access access) {
  int const flags = access == Access::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* opened = nullptr;
  int const code = sqlite3_open_v2(file.c_str(), &opened, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  Connection connection(opened);
  if (code != SQLITE_OK)
    return base::fail(base::ErrorKind::io, fmt::format("{}: {}", file.string(), sqlite3_errstr(code)),
                      "see that the folder is there and may be written to");
  sqlite3_busy_timeout(connection.get(), busy_timeout_ms);
  sqlite3_extended_result_codes(connection.get(), 1);
  define_functions(connection.get());
  auto database = std::make_unique<Sqlite>(std::move(connection), file.string());
  // Space that retention frees goes back to the disk in small steps; only a file without tables takes this word.
  auto const* const settings = access == Access::read ? "PRAGMA foreign_keys = ON; PRAGMA query_only = ON"
                                                      : "PRAGMA auto_vacuum = INCREMENTAL;"
                                                        "PRAGMA journal_mode = WAL;"
                                                        "PRAGMA synchronous = FULL;"
                                                        "PRAGMA journal_size_limit = 16777216;"
                                                        "PRAGMA foreign_keys = ON";
  if (auto set = database->execute(settings); !set) return std::unexpected(set.error());
  return database;
}

}  // namespace lapwing::map::sql
