#include <fmt/format.h>

#include "map/store/care/care.hpp"
#include "map/store/reader.hpp"
#include "map/store/rows/shown_rows.hpp"
#include "map/store/schema/migrate.hpp"
#include "map/store/schema/tables.hpp"

namespace lapwing::map::care {

namespace {

/// Reads several answers one after the other; after the first error there are no more.
class Numbers {
 public:
  explicit Numbers(sql::Database& database) : database_(database) {}

  std::uint64_t of(std::string const& query) {
    if (error) return 0;
    auto const value = sql::value_of(database_, query);
    if (!value) error = value.error();
    return value ? static_cast<std::uint64_t>(sql::as_integer(*value).value_or(0)) : 0;
  }
  std::vector<sql::Row> rows(std::string const& query) {
    if (error) return {};
    auto rows = sql::rows_of(database_, query);
    if (!rows) error = rows.error();
    return rows ? std::move(*rows) : std::vector<sql::Row>();
  }
  std::optional<base::Error> error;

 private:
  sql::Database& database_;
};

}  // namespace

base::Result<Summary> summary(std::string const& address) {
  place::Address const place(address);
  auto const reader = Reader::open(place);
  if (!reader) return std::unexpected(reader.error());
  auto& database = *(*reader)->database;
  if (auto checked = schema::check(database, place.name()); !checked) return std::unexpected(checked.error());
  Numbers numbers(database);
  Summary summary{.version = schema::version};
  for (auto const layer : all_layers)
    summary.features[layer] = numbers.of(fmt::format("SELECT count(*) FROM {}", name_of(layer)));
  summary.removed = numbers.of("SELECT count(*) FROM removed");
  summary.tile_shades = numbers.of("SELECT count(*) FROM tile_shades");
  summary.pictures = numbers.of("SELECT count(*) FROM blobs");
  summary.picture_bytes = numbers.of("SELECT CAST(coalesce(sum(bytes), 0) AS BIGINT) FROM blobs");
  for (auto const& row : numbers.rows("SELECT id FROM sites ORDER BY id"))
    summary.sites.push_back(sql::as_text(row[0]));
  for (auto const& row :
       numbers.rows("SELECT site, floor, name, count(*) FROM grid_tiles WHERE cells IS NOT NULL GROUP "
                    "BY site, floor, name"))
    summary.grid_tiles[{sql::as_text(row[0]), sql::as_text(row[1]), sql::as_text(row[2])}] =
        static_cast<std::uint64_t>(sql::as_integer(row[3]).value_or(0));
  if (numbers.error) return std::unexpected(*numbers.error);
  auto sessions = rows::read_sessions(database);
  if (!sessions) return std::unexpected(sessions.error());
  summary.sessions = std::move(*sessions);
  auto const bytes = bytes_in_use(database);
  if (!bytes) return std::unexpected(bytes.error());
  summary.bytes = *bytes;
  return summary;
}

}  // namespace lapwing::map::care
