#include "map/basemaps/mbtiles.hpp"

#include "map/basemaps/vector_layers.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <charconv>
#include <string_view>
#include <utility>

namespace lapwing::map {

namespace {

using base::ErrorKind;
using base::fail;

constexpr int most_tile_bytes = 8 * 1024 * 1024;

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

std::string text_at(sqlite3_stmt* statement, int column) {
  auto const* text = reinterpret_cast<char const*>(sqlite3_column_text(statement, column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(statement, column))) : std::string();
}

std::string media_type_of(std::string_view format) {
  if (format == "jpg" || format == "jpeg") return "image/jpeg";
  if (format == "webp") return "image/webp";
  if (format == "pbf") return "application/x-protobuf";
  return "image/png";
}

void read_bounds(std::string_view text, TileArchiveInfo& info) {
  std::array<double, 4> bounds{};
  auto const* at = text.data();
  auto const* const end = text.data() + text.size();
  for (auto& number : bounds) {
    while (at != end && (*at == ' ' || *at == ',')) ++at;
    auto const [after, error] = std::from_chars(at, end, number);
    if (error != std::errc{}) return;
    at = after;
  }
  if (bounds[0] < bounds[2] && bounds[1] < bounds[3]) info.bounds_deg = bounds;
}

std::uint32_t zoom_in(std::string_view text, std::uint32_t fallback) {
  std::uint32_t zoom = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), zoom);
  return error == std::errc{} && zoom <= TileAddress::deepest_zoom ? zoom : fallback;
}

class MbTiles final : public TileArchive {
 public:
  explicit MbTiles(Database database) : database_(std::move(database)) { read_metadata(); }

  [[nodiscard]] TileArchiveInfo const& info() const override { return info_; }

  [[nodiscard]] base::Result<std::optional<std::string>> tile(TileAddress const& address) const override {
    if (!address.is_valid()) return std::optional<std::string>();
    // A statement a call: threads share the connection, which SQLite serializes, but no statement.
    auto const statement = prepared(
        database_.get(), "SELECT tile_data FROM tiles WHERE zoom_level = ? AND tile_column = ? AND tile_row = ?");
    if (!statement) return told();
    auto const row_from_south = (1U << address.zoom) - 1 - address.y;
    sqlite3_bind_int64(statement.get(), 1, address.zoom);
    sqlite3_bind_int64(statement.get(), 2, address.x);
    sqlite3_bind_int64(statement.get(), 3, row_from_south);
    int const state = sqlite3_step(statement.get());
    if (state == SQLITE_DONE) return std::optional<std::string>();
    if (state != SQLITE_ROW) return told();
    int const size = sqlite3_column_bytes(statement.get(), 0);
    if (size > most_tile_bytes) return fail(ErrorKind::invalid_input, "a tile of the archive is larger than 8 MiB");
    auto const* bytes = static_cast<char const*>(sqlite3_column_blob(statement.get(), 0));
    return std::optional(bytes ? std::string(bytes, static_cast<std::size_t>(size)) : std::string());
  }

 private:
  [[nodiscard]] std::unexpected<base::Error> told() const {
    return fail(ErrorKind::io, fmt::format("the MBTiles archive cannot be read: {}", sqlite3_errmsg(database_.get())));
  }

  void read_metadata() {
    auto const rows = prepared(database_.get(), "SELECT name, value FROM metadata LIMIT 1000");
    std::string format = "png";
    while (rows && sqlite3_step(rows.get()) == SQLITE_ROW) {
      auto const name = text_at(rows.get(), 0);
      auto value = text_at(rows.get(), 1);
      if (name == "name")
        info_.name = std::move(value);
      else if (name == "attribution")
        info_.attribution = std::move(value);
      else if (name == "json")
        info_.vector_layers = vector_layers_of(value);
      else if (name == "format")
        format = std::move(value);
      else if (name == "minzoom")
        info_.least_zoom = zoom_in(value, info_.least_zoom);
      else if (name == "maxzoom")
        info_.greatest_zoom = zoom_in(value, info_.greatest_zoom);
      else if (name == "bounds")
        read_bounds(value, info_);
    }
    info_.media_type = media_type_of(format);
    // Vector tiles lie packed in these archives.
    if (format == "pbf") info_.encoding = "gzip";
  }

  Database database_;
  TileArchiveInfo info_;
};

}  // namespace

base::Result<std::shared_ptr<TileArchive const>> open_mbtiles(std::filesystem::path const& path) {
  sqlite3* opened = nullptr;
  int const state = sqlite3_open_v2(path.c_str(), &opened, SQLITE_OPEN_READONLY | SQLITE_OPEN_FULLMUTEX, nullptr);
  Database database(opened);
  if (state != SQLITE_OK)
    return fail(ErrorKind::io, fmt::format("{} cannot be opened: {}", path.string(), sqlite3_errstr(state)));
  // A file of somebody else's must not run anything: views may, functions and triggers of theirs may not.
  sqlite3_db_config(database.get(), SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(database.get(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  if (!prepared(database.get(), "SELECT zoom_level, tile_column, tile_row, tile_data FROM tiles"))
    return fail(ErrorKind::invalid_input,
                fmt::format("{} has no map tiles: {}", path.string(), sqlite3_errmsg(database.get())));
  return std::make_shared<MbTiles const>(std::move(database));
}

}  // namespace lapwing::map
