#include "map/store/rows/grid_rows.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "map/store/rows/zlib.hpp"
#include "map/store/schema/tables.hpp"

namespace lapwing::map::rows {

namespace {

using sql::Row;

// A cell lies in the column as it does in memory.
static_assert(std::is_trivially_copyable_v<Evidence> && sizeof(Evidence) == 2);
static_assert(std::endian::native == std::endian::little);

constexpr std::size_t tile_bytes = sizeof(GridTile::cells);

Row key_row(GridKey const& key) {
  return {key.site, key.floor, key.name};
}

/// Whether both say the same of where cells lie.
bool is_alike(GridPart const& a, GridPart const& b) {
  return a.resolution_m == b.resolution_m && a.site_from_grid.origin() == b.site_from_grid.origin() &&
         a.site_from_grid.yaw_rad() == b.site_from_grid.yaw_rad();
}

GridPart part_of(Row const& row, std::size_t from) {
  auto const real = [&](std::size_t i) { return sql::as_real(row[from + i]).value_or(0.0); };
  return {
      .resolution_m = real(0),
      .site_from_grid = {geo::Point<geo::SiteFrame>(real(1), real(2)), real(3)},
      .account = {sql::as_text(row[from + 4]), sql::time_of_nanoseconds(sql::as_integer(row[from + 5]).value_or(0))}};
}

base::Result<> take_out_another(sql::Database& database, GridKey const& key, GridPart const& part) {
  auto const found = sql::rows_of(database,
                                  "SELECT resolution_m, origin_x_m, origin_y_m, origin_yaw_rad, writer, at_ns "
                                  "FROM grids WHERE site = $1 AND floor = $2 AND name = $3",
                                  key_row(key));
  if (!found) return std::unexpected(found.error());
  if (found->empty() || is_alike(part_of(found->front(), 0), part)) return {};
  auto const gone = database.change("DELETE FROM grids WHERE site = $1 AND floor = $2 AND name = $3", key_row(key));
  return gone ? base::Result<>() : std::unexpected(gone.error());
}

}  // namespace

std::string packed(GridTile const& tile) {
  return deflated({reinterpret_cast<char const*>(tile.cells.data()), tile_bytes});
}

std::shared_ptr<GridTile const> unpacked(std::string_view cells) {
  auto const bytes = inflated(cells, tile_bytes);
  if (!bytes || bytes->size() != tile_bytes) return nullptr;
  auto tile = std::make_shared<GridTile>();
  std::memcpy(tile->cells.data(), bytes->data(), tile_bytes);
  bool const is_sound = std::ranges::all_of(
      tile->cells, [](Evidence cell) { return std::abs(cell.log_odds()) <= Evidence::most_log_odds; });
  return is_sound ? tile : nullptr;
}

base::Result<> write_grid(sql::Database& database, GridKey const& key, GridPart const& part, Revision revision) {
  if (auto out = take_out_another(database, key, part); !out) return out;
  auto const number = static_cast<std::int64_t>(revision);
  auto const origin = part.site_from_grid.origin();
  auto const put =
      database.put(schema::table::grids,
                   {"site", "floor", "name", "resolution_m", "origin_x_m", "origin_y_m", "origin_yaw_rad", "writer",
                    "at_ns", "revision"},
                   {{key.site, key.floor, key.name, part.resolution_m, origin.x(), origin.y(),
                     part.site_from_grid.yaw_rad(), part.account.writer, sql::nanoseconds(part.account.at), number}});
  if (!put) return put;
  std::vector<Row> tiles;
  for (auto const& [where, kept] : part.tiles) {
    // An empty one stays as a row without cells: so older news of it are known as such.
    auto const cells = kept.tile ? sql::Value(sql::Bytes{packed(*kept.tile)}) : sql::Value();
    tiles.push_back({key.site, key.floor, key.name, std::int64_t{where.x}, std::int64_t{where.y}, cells,
                     sql::nanoseconds(kept.at), number});
  }
  return database.put(schema::table::grid_tiles, {"site", "floor", "name", "x", "y", "cells", "at_ns", "revision"},
                      tiles);
}

base::Result<std::map<GridKey, GridPart>> read_grids(sql::Database& database, Revision since) {
  std::map<GridKey, GridPart> grids;
  auto const read = database.query(
      "SELECT site, floor, name, resolution_m, origin_x_m, origin_y_m, origin_yaw_rad, writer, at_ns FROM grids "
      "WHERE revision > $1",
      {static_cast<std::int64_t>(since)}, [&](Row const& row) -> base::Result<> {
        GridKey const key{sql::as_text(row[0]), sql::as_text(row[1]), sql::as_text(row[2])};
        auto part = part_of(row, 3);
        if (!(part.resolution_m >= 0.001 && part.resolution_m <= 100.0))
          return base::fail(base::ErrorKind::io, fmt::format("grid \"{}\" in the store: its resolution is {} m",
                                                             key.name, part.resolution_m));
        grids.emplace(key, std::move(part));
        return {};
      });
  if (!read) return std::unexpected(read.error());
  return grids;
}

base::Result<KeptTiles> read_tiles(sql::Database& database, GridKey const& key, Revision since) {
  KeptTiles tiles;
  auto values = key_row(key);
  values.emplace_back(static_cast<std::int64_t>(since));
  auto const read = database.query(
      "SELECT x, y, cells, at_ns FROM grid_tiles WHERE site = $1 AND floor = $2 AND name = $3 AND revision > $4",
      values, [&](Row const& row) -> base::Result<> {
        TileKey const where{static_cast<std::int32_t>(sql::as_integer(row[0]).value_or(0)),
                            static_cast<std::int32_t>(sql::as_integer(row[1]).value_or(0))};
        auto const cells = sql::as_bytes(row[2]);
        auto const tile = cells.empty() ? nullptr : unpacked(cells);
        if (!tile && !cells.empty())
          return base::fail(base::ErrorKind::io, fmt::format("grid \"{}\" in the store: the cells of tile ({}, {}) "
                                                             "cannot be read",
                                                             key.name, where.x, where.y));
        tiles.emplace(where, KeptTile{tile, sql::time_of_nanoseconds(sql::as_integer(row[3]).value_or(0))});
        return {};
      });
  if (!read) return std::unexpected(read.error());
  return tiles;
}

}  // namespace lapwing::map::rows
