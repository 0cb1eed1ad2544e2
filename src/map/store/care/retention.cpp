#include "map/store/care/retention.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "map/live/live_map.hpp"

namespace lapwing::map::care {

namespace {

using sql::Row;

/// Chunks and pictures at a time.
constexpr std::int64_t slice = 200;
/// Pages that go back to the disk at a time.
constexpr auto give_back = "PRAGMA incremental_vacuum(1000)";

/// Lists of grids name what they have at least so often, with a little to spare.
constexpr std::chrono::minutes shades_linger{20};

enum class Kind : std::int64_t { shades = -1, picture = 0, chunk = 1 };

struct Old {
  Kind kind;
  std::string session;
  std::string name;  ///< of a chunk its feed, of a picture its hash
  std::int64_t number;
  std::uint64_t bytes;
};

base::Result<std::int64_t> number_of(sql::Database& database, std::string const& statement, Row const& values = {}) {
  auto const value = sql::value_of(database, statement, values);
  if (!value) return std::unexpected(value.error());
  return sql::as_integer(*value).value_or(0);
}

/// The live map remembers no more of them either.
base::Result<> forget_removals(sql::Database& database) {
  for (auto const layer : all_layers) {
    auto const gone = database.change(
        "DELETE FROM removed WHERE layer = $1 AND revision < (SELECT revision FROM removed WHERE layer = $1 ORDER BY "
        "revision DESC LIMIT 1 OFFSET $2)",
        {std::string(name_of(layer)), static_cast<std::int64_t>(most_removals - 1)});
    if (!gone) return std::unexpected(gone.error());
  }
  return {};
}

base::Result<std::vector<Old>> older_than(sql::Database& database, base::UtcTime time) {
  std::vector<Old> found;
  auto const read =
      database.query("SELECT session, feed, number FROM shown_chunks WHERE last_ns < $1 ORDER BY last_ns LIMIT $2",
                     {sql::nanoseconds(time), slice}, [&](Row const& row) -> base::Result<> {
                       found.push_back({Kind::chunk, sql::as_text(row[0]), sql::as_text(row[1]),
                                        sql::as_integer(row[2]).value_or(0), 0});
                       return {};
                     });
  if (!read) return std::unexpected(read.error());
  return found;
}

/// What none of the moments since then shows.
base::Result<std::vector<Old>> shades_older_than(sql::Database& database, base::UtcTime time) {
  std::vector<Old> found;
  auto const read =
      database.query("SELECT name FROM tile_shades WHERE last_ns < $1 ORDER BY last_ns LIMIT $2",
                     {sql::nanoseconds(time - shades_linger), slice}, [&](Row const& row) -> base::Result<> {
                       found.push_back({Kind::shades, "", sql::as_text(row[0]), 0, 0});
                       return {};
                     });
  if (!read) return std::unexpected(read.error());
  return found;
}

/// Enough of the oldest, as far as one slice goes.
base::Result<std::vector<Old>> oldest(sql::Database& database, std::uint64_t bytes) {
  std::vector<Old> found;
  std::uint64_t sum = 0;
  auto const read = database.query(
      "SELECT 1 AS kind, session, feed, number, length(content) AS bytes, last_ns AS at FROM shown_chunks UNION ALL "
      "SELECT 0, '', hash, 0, bytes, at_ns FROM blobs UNION ALL "
      "SELECT -1, '', name, 0, length(shades), last_ns FROM tile_shades ORDER BY at LIMIT $1",
      {slice}, [&](Row const& row) -> base::Result<> {
        if (sum >= bytes) return {};
        auto const number = [&](std::size_t i) { return sql::as_integer(row[i]).value_or(0); };
        found.push_back({static_cast<Kind>(number(0)), sql::as_text(row[1]), sql::as_text(row[2]), number(3),
                         static_cast<std::uint64_t>(number(4))});
        sum += found.back().bytes;
        return {};
      });
  if (!read) return std::unexpected(read.error());
  return found;
}

base::Result<> take_away(sql::Database& database, blobs::Bytes& bytes, std::vector<Old> const& all) {
  auto transaction = sql::Transaction::begin(database);
  if (!transaction) return std::unexpected(transaction.error());
  std::vector<Row> chunks, pictures, shades;
  for (auto const& one : all) {
    switch (one.kind) {
      case Kind::chunk: chunks.push_back({one.session, one.name, one.number}); break;
      case Kind::picture: pictures.push_back({one.name}); break;
      case Kind::shades: shades.push_back({one.name}); break;
    }
  }
  auto done = database.change_each("DELETE FROM shown_chunks WHERE session = $1 AND feed = $2 AND number = $3", chunks);
  if (done) done = database.change_each("DELETE FROM blobs WHERE hash = $1", pictures);
  // What others hang on is as young as they are, and goes after them.
  if (done)
    done = database.change_each(
        "DELETE FROM tile_shades WHERE name = $1 AND NOT EXISTS (SELECT 1 FROM tile_shades other WHERE other.base = "
        "$1)",
        shades);
  if (done)
    done = database.execute(
        "DELETE FROM sessions WHERE NOT EXISTS (SELECT 1 FROM shown_chunks WHERE session = sessions.id) AND EXISTS "
        "(SELECT 1 FROM sessions other WHERE other.began_ns > sessions.began_ns)");
  if (done) done = transaction->commit();
  if (!done) return done;
  // After their rows: a row without its file would be a fault, a file without a row is none.
  for (auto const& one : all)
    if (one.kind == Kind::picture) bytes.remove(one.name);
  return {};
}

}  // namespace

base::Result<std::uint64_t> bytes_in_use(sql::Database& database) {
  auto const pictures = number_of(database, "SELECT CAST(coalesce(sum(bytes), 0) AS BIGINT) FROM blobs");
  if (!pictures) return std::unexpected(pictures.error());
  auto tables = base::Result<std::int64_t>(0);
  if (database.dialect() == sql::Dialect::geopackage) {
    tables = number_of(database,
                       "SELECT (c.page_count - f.freelist_count) * s.page_size FROM pragma_page_count() c, "
                       "pragma_freelist_count() f, pragma_page_size() s");
  } else {
    // What the tables take on its disk does not shrink with what is deleted: the server fills the gaps by itself.
    tables = number_of(database, "SELECT CAST(coalesce(sum(length(content)), 0) AS BIGINT) FROM shown_chunks");
    auto const cells = number_of(database, "SELECT CAST(coalesce(sum(length(cells)), 0) AS BIGINT) FROM grid_tiles");
    if (!cells) return std::unexpected(cells.error());
    if (tables) *tables += *cells;
    auto const shades = number_of(database, "SELECT CAST(coalesce(sum(length(shades)), 0) AS BIGINT) FROM tile_shades");
    if (!shades) return std::unexpected(shades.error());
    if (tables) *tables += *shades;
    for (auto const layer : all_layers) {
      auto const size = number_of(database, fmt::format("SELECT pg_total_relation_size('{}')", name_of(layer)));
      if (!size) return std::unexpected(size.error());
      if (tables) *tables += *size;
    }
  }
  if (!tables) return std::unexpected(tables.error());
  return static_cast<std::uint64_t>(*tables + *pictures);
}

base::Result<bool> retain(sql::Database& database, blobs::Bytes& bytes, Limits const& limits, base::UtcTime now) {
  if (auto forgotten = forget_removals(database); !forgotten) return std::unexpected(forgotten.error());
  bool is_more = false;
  auto const go = [&](base::Result<std::vector<Old>> const& found) -> base::Result<> {
    if (!found) return std::unexpected(found.error());
    if (found->empty()) return {};
    is_more = true;
    return take_away(database, bytes, *found);
  };
  if (limits.longest) {
    auto const horizon = now - *limits.longest;
    if (auto gone = go(older_than(database, horizon)); !gone) return std::unexpected(gone.error());
    if (auto gone = go(shades_older_than(database, horizon)); !gone) return std::unexpected(gone.error());
  }
  if (limits.most_bytes) {
    auto const used = bytes_in_use(database);
    if (!used) return std::unexpected(used.error());
    if (*used > *limits.most_bytes)
      if (auto gone = go(oldest(database, *used - *limits.most_bytes)); !gone) return std::unexpected(gone.error());
  }
  if (database.dialect() == sql::Dialect::postgis) return is_more;
  auto const free = number_of(database, "PRAGMA freelist_count");
  if (!free) return std::unexpected(free.error());
  if (*free == 0) return is_more;
  if (auto given = database.execute(give_back); !given) return std::unexpected(given.error());
  return true;
}

}  // namespace lapwing::map::care
