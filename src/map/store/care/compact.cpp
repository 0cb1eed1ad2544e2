#include <chrono>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/wall_clock.hpp"
#include "map/store/care/care.hpp"
#include "map/store/reader.hpp"
#include "map/store/schema/migrate.hpp"
#include "map/store/schema/tables.hpp"

namespace lapwing::map::care {

namespace {

base::Result<> give_space_back(sql::Database& database) {
  if (database.dialect() == sql::Dialect::geopackage)
    return database.execute("VACUUM; PRAGMA wal_checkpoint(TRUNCATE)");
  for (auto const* table : schema::all_tables())
    if (auto done = database.execute(fmt::format("VACUUM (ANALYZE) {}", table->name)); !done) return done;
  return {};
}

/// Files of which no row tells: somebody was stopped between the two.
base::Result<std::uint64_t> remove_strays(sql::Database& database, blobs::Bytes& bytes) {
  auto const told = sql::rows_of(database, "SELECT hash FROM blobs");
  if (!told) return std::unexpected(told.error());
  auto const present = bytes.all_hashes();
  if (!present) return std::unexpected(present.error());
  std::set<std::string> known;
  for (auto const& row : *told) known.insert(sql::as_text(row[0]));
  std::uint64_t count = bytes.remove_leftovers();
  for (auto const& hash : *present) {
    if (known.contains(hash)) continue;
    bytes.remove(hash);
    ++count;
  }
  return count;
}

}  // namespace

base::Result<Compacted> compact(std::string const& address, Limits const& limits) {
  place::Address const place(address);
  // First whether there is one at all: to lock a folder would make it.
  if (auto const reader = Reader::open(place); !reader) return std::unexpected(reader.error());
  std::optional<place::FolderLock> lock;
  if (!place.is_server()) {
    auto taken = place::FolderLock::take(place);
    if (!taken) return std::unexpected(taken.error());
    lock.emplace(std::move(*taken));
  }
  auto const database = place::open_database(place, sql::Access::write);
  if (!database) return std::unexpected(database.error());
  if (auto prepared = schema::prepare(**database, place.name()); !prepared) return std::unexpected(prepared.error());
  auto const bytes = place::open_bytes(place, **database);
  Compacted compacted;
  auto const before = bytes_in_use(**database);
  if (!before) return std::unexpected(before.error());
  compacted.bytes_before = *before;
  for (bool is_more = true; is_more;) {
    auto const more = retain(**database, *bytes, limits, base::wall_now());
    if (!more) return std::unexpected(more.error());
    is_more = *more;
  }
  // On a server the bytes lie with their rows; there are no strays.
  auto const strays = place.is_server() ? base::Result<std::uint64_t>(0) : remove_strays(**database, *bytes);
  if (!strays) return std::unexpected(strays.error());
  compacted.stray_pictures = *strays;
  if (auto given = give_space_back(**database); !given) return std::unexpected(given.error());
  auto const after = bytes_in_use(**database);
  if (!after) return std::unexpected(after.error());
  compacted.bytes_after = *after;
  return compacted;
}

}  // namespace lapwing::map::care
