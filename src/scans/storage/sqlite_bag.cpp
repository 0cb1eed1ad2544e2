#include "scans/storage/sqlite_bag.hpp"

#include <sqlite3.h>

#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace lapwing::scans {

namespace {

using base::ErrorKind;
using base::fail;

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Close>;
using Statement = std::unique_ptr<sqlite3_stmt, Close>;

Statement prepared(sqlite3* database, char const* sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database, sql, -1, &statement, nullptr);
  return Statement(statement);
}

std::string_view bytes_at(sqlite3_stmt* row, int column) {
  auto const* bytes = static_cast<char const*>(sqlite3_column_blob(row, column));
  return bytes == nullptr ? std::string_view()
                          : std::string_view(bytes, static_cast<std::size_t>(sqlite3_column_bytes(row, column)));
}

class SqliteBag {
 public:
  SqliteBag(Database database, BagListener& listener) : database_(std::move(database)), listener_(listener) {}

  base::Result<BagRemark> run() {
    if (auto done = read_schema(); !done) return std::unexpected(done.error());
    if (auto done = read_topics(); !done) return std::unexpected(done.error());
    if (auto done = read_messages(); !done) return std::unexpected(done.error());
    return remark_;
  }

 private:
  [[nodiscard]] std::unexpected<base::Error> unreadable() const {
    return fail(ErrorKind::invalid_input, fmt::format("SQLite cannot read it: {}", sqlite3_errmsg(database_.get())));
  }

  /// The two tables are tables: a view of a stranger's could compute for as long as it likes.
  base::Result<> read_schema() {
    static constexpr auto* tables =
        "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN ('topics', 'messages') "
        "AND sql LIKE 'CREATE TABLE%'";
    auto rows = prepared(database_.get(), tables);
    if (!rows && sqlite3_errcode(database_.get()) == SQLITE_CORRUPT) {
      // It is shorter than it says itself. Read as one whose schema is being mended, that is no obstacle.
      sqlite3_db_config(database_.get(), SQLITE_DBCONFIG_WRITABLE_SCHEMA, 1, nullptr);
      remark_ = "the file is cut off or damaged; what SQLite gets at was read";
      rows = prepared(database_.get(), tables);
    }
    if (!rows || sqlite3_step(rows.get()) != SQLITE_ROW) return unreadable();
    if (sqlite3_column_int(rows.get(), 0) != 2)
      return fail(ErrorKind::invalid_input,
                  "a database, but not one of rosbag2: it lacks the tables topics and messages");
    return {};
  }

  base::Result<> read_topics() {
    auto const rows = prepared(database_.get(), "SELECT id, name, type, serialization_format FROM topics");
    if (!rows) return unreadable();
    int state = sqlite3_step(rows.get());
    for (; state == SQLITE_ROW; state = sqlite3_step(rows.get())) {
      if (topics_.size() == most_topics)
        return fail(ErrorKind::invalid_input, fmt::format("more than {} topics", most_topics));
      BagTopic topic{
          .name = name_at(rows.get(), 1), .type = name_at(rows.get(), 2), .encoding = name_at(rows.get(), 3)};
      bool const is_wanted = listener_.wants(topic);
      topics_.emplace(sqlite3_column_int64(rows.get(), 0), Topic{.topic = std::move(topic), .is_wanted = is_wanted});
    }
    return state == SQLITE_DONE ? base::Result<>() : unreadable();
  }

  base::Result<> read_messages() {
    auto const rows = prepared(database_.get(), "SELECT topic_id, timestamp, data FROM messages");
    if (!rows) return unreadable();
    int state = sqlite3_step(rows.get());
    for (; state == SQLITE_ROW; state = sqlite3_step(rows.get())) {
      auto const topic = topics_.find(sqlite3_column_int64(rows.get(), 0));
      if (topic == topics_.end() || !topic->second.is_wanted) continue;
      auto const logged = std::chrono::nanoseconds(sqlite3_column_int64(rows.get(), 1));
      if (auto done = listener_.take(topic->second.topic, logged, bytes_at(rows.get(), 2)); !done) return done;
    }
    if (state == SQLITE_TOOBIG)
      return fail(ErrorKind::invalid_input, fmt::format("a message of more than {} MB", most_packed_together >> 20));
    if (state != SQLITE_DONE)
      remark_ = fmt::format("the file is cut off or damaged ({}); what lies before was read",
                            sqlite3_errmsg(database_.get()));
    return {};
  }

  static std::string name_at(sqlite3_stmt* row, int column) {
    constexpr std::size_t longest_name = 1000;
    return std::string(bytes_at(row, column).substr(0, longest_name));
  }

  struct Topic {
    BagTopic topic;
    bool is_wanted = false;
  };

  Database database_;
  BagListener& listener_;
  std::map<std::int64_t, Topic> topics_;
  BagRemark remark_;
};

}  // namespace

bool is_sqlite(std::string_view beginning) {
  return beginning.starts_with(std::string_view("SQLite format 3\0", 16));
}

base::Result<BagRemark> read_sqlite_bag(std::filesystem::path const& file, BagListener& listener) {
  sqlite3* opened = nullptr;
  int const state = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX, nullptr);
  Database database(opened);
  if (state != SQLITE_OK) return fail(ErrorKind::io, fmt::format("cannot be opened: {}", sqlite3_errstr(state)));
  // A file of somebody else's must not run anything.
  sqlite3_db_config(database.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_limit(database.get(), SQLITE_LIMIT_LENGTH, static_cast<int>(most_packed_together));
  return SqliteBag(std::move(database), listener).run();
}

}  // namespace lapwing::scans
